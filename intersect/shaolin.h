#pragma once
/// ShaoLin, the shadow of the line: ray queries on the limit surface of a subdivision mesh (Mueller, Techmann, Fellner,
/// "Adaptive ray tracing of subdivision surfaces", Eurographics 2003), with an exact finish in place of chord
/// triangles.
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "../schemes/scheme_surface.h"
#include "bvh.h"
#include "counters.h"
#include "exact_finish.h"
#include "face_bounds.h"
#include "flatten.h"
#include "patch_tree.h"
#include "ray_frame.h"
#include "refining_finish.h"

namespace shaolin {

/// What a query looks for: the closest hit, or any.
enum class Query { closest, any };

template <Scheme S, template <class> class Finish>
class ShaoLin {
 public:
  /// Bounds every face (see face_bounds.h) and builds the hierarchy. O(n log n); nothing is refined yet. Throws
  /// InputError if a face has no finite bound.
  explicit ShaoLin(const SchemeSurface<S>& surface);

  /// The hit with the least t in [tmin, tmax]. Of hits at equal distance, the face visited first wins; the order of
  /// visits depends on the ray alone. The work goes to `counters`. Throws InputError where masks turn out not to
  /// converge.
  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const;

  /// True if there is a hit in [tmin, tmax].
  bool occluded(const Ray& ray, RayCounters& counters) const;

  /// A box that holds the surface.
  const Box& bounds() const { return bvh_.bounds(); }

  /// Adds what rays have made so far, and the memory that it takes.
  void add_to(Statistics& total) const {
    total.faces += primitives_.size();
    total.faces_touched += faces_touched_;
    total.patches_split += totals_.patches_split;
    total.bytes +=
        totals_.bytes + bvh_.bytes() + primitives_.size() * (sizeof(Primitive) + sizeof(std::atomic<StartPatch*>));
  }

 private:
  using Node = PatchNode<S>;
  using Regular = RegularPatch<S::face_kind>;

  /// A start patch: the patch of a face, or of an n-gon's corner, its own box, which is tighter than the face's in the
  /// hierarchy, and the normal of its plane TP; made when a ray first reaches the face's box.
  struct StartPatch {
    SceneBox box;
    Node root;
    Vec3 normal;

    StartPatch(Patch<S> patch, int level, const Vec3& plane_normal, const BoxSpace& space, TreeTotals& totals)
        : box({}, space), root(std::move(patch), level, space, totals), normal(plane_normal) {
      box = SceneBox(root.box(), space);
    }
  };

  /// What a leaf of the hierarchy stands for.
  struct Primitive {
    int face, sub;
  };

  /// A place in a node's parameters, met at a distance along the ray.
  struct Found {
    const Node* node = nullptr;
    PatchHit hit;
    int face = 0;
    int sub = 0;
  };

  /// A ray on its way through one start patch.
  struct Search {
    Search(const TraversalRay& along, const BoxRay& among, const Vec3& normal, double horizon, RayCounters& count)
        : ray(along), box_ray(among), plane_normal(normal), far(horizon), counters(count) {}

    const TraversalRay& ray;
    const BoxRay& box_ray;
    const Vec3& plane_normal;
    double far;
    float box_far = box_ray.local(far);
    RayCounters& counters;
    const Node* found = nullptr;
    PatchHit hit;

    /// The ray's frame, made when a patch first asks: most rays miss the boxes of most patches.
    const RayFrame& frame() {
      if (!frame_) frame_.emplace(ray, plane_normal);
      return *frame_;
    }

    /// The nearest hit so far.
    void take(const Node& node, const PatchHit& nearest) {
      found = &node;
      hit = nearest;
      far = std::min(far, nearest.distance);
      box_far = box_ray.local(far);
    }

   private:
    std::optional<RayFrame> frame_;
  };

  const StartPatch& start_patch(int primitive) const {
    const StartPatch* known = start_patches_[static_cast<std::size_t>(primitive)].load(std::memory_order_acquire);
    return known ? *known : make_start_patch(primitive);
  }
  const StartPatch& make_start_patch(int primitive) const;
  Vec3 plane_normal(const Patch<S>& patch) const;
  template <Query query>
  void descend(const Node& node, Search& search) const;
  void finish(const Node& node, Search& search) const;
  void finish_by_refinement(const Node& node, Search& search) const;
  void finish_irregular(const Node& node, const Box& hull, Search& search) const;
  template <Query query>
  Found search(const TraversalRay& ray, RayCounters& counters) const;
  LimitSample sample(const Found& found, const SurfaceParameter& at) const;
  static LimitSample polynomial_sample(const Found& found);

  const SchemeSurface<S>& surface_;
  std::vector<Primitive> primitives_;
  Bvh bvh_;
  mutable std::vector<std::atomic<StartPatch*>> start_patches_;
  mutable TreeTotals totals_;
  mutable std::atomic<std::uint64_t> faces_touched_{0};

 public:
  ~ShaoLin() {
    for (auto& slot : start_patches_) delete slot.load();
  }
  ShaoLin(const ShaoLin&) = delete;
  ShaoLin& operator=(const ShaoLin&) = delete;
};

template <Scheme S, template <class> class Finish>
ShaoLin<S, Finish>::ShaoLin(const SchemeSurface<S>& surface) : surface_(surface) {
  const SubdivisionMesh<S>& mesh = surface.mesh();
  const std::vector<Box> bounds = face_bounds(mesh);
  std::vector<Box> boxes;
  for (const int f : mesh.faces()) {
    if (!mesh.has_limit(f)) continue;
    Box box = bounds[static_cast<std::size_t>(f)];
    const double slack = 160 * unit_roundoff * box.largest_coordinate();
    box.lower.array() -= slack;
    box.upper.array() += slack;
    if (!box.lower.allFinite() || !box.upper.allFinite())
      throw InputError("nothing bounds the surface of face " + std::to_string(f) +
                       ": its coordinates are too large, or the masks of the scheme do not sum to one or not "
                       "converge; see 'shaolin scheme check'");
    for (int sub = 0; sub < surface.sub_count(f); ++sub) {
      boxes.push_back(box);
      primitives_.push_back({f, sub});
    }
  }
  bvh_ = Bvh(boxes);
  start_patches_ = std::vector<std::atomic<StartPatch*>>(boxes.size());
}

/// The normal of TP: of the plane through the corners' limit points (section 8.2 for quads). A corner whose limit masks
/// do not apply yet lends its control point; the plane only serves to orient RP and CP.
template <Scheme S, template <class> class Finish>
Vec3 ShaoLin<S, Finish>::plane_normal(const Patch<S>& patch) const {
  std::vector<Vec3> corners;
  for (int k = 0; k < patch.configuration->corner_count(); ++k) {
    const std::optional<LimitAtCorner> limit = corner_limit(patch, k);
    corners.push_back(limit ? limit->position : patch.points[static_cast<std::size_t>(k)]);
  }
  using Base = std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh>;
  return Base::chord_normal(corners);
}

template <Scheme S, template <class> class Finish>
auto ShaoLin<S, Finish>::make_start_patch(int primitive) const -> const StartPatch& {
  const auto [face, sub] = primitives_[static_cast<std::size_t>(primitive)];
  Patch<S> patch = surface_.patch(face, sub);
  const Vec3 normal = plane_normal(patch);
  TreeTotals made_totals;  // counted if no other thread is first
  auto made = std::make_unique<StartPatch>(std::move(patch), surface_.splits_by_corner(face), normal, bvh_.space(),
                                           made_totals);
  std::atomic<StartPatch*>& slot = start_patches_[static_cast<std::size_t>(primitive)];
  StartPatch* expected = nullptr;
  if (!slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  totals_.bytes += made_totals.bytes + sizeof(StartPatch) + made->root.own_bytes();
  totals_.patches_split += made_totals.patches_split;
  ++faces_touched_;
  return *made.release();
}

template <Scheme S, template <class> class Finish>
template <Query query>
auto ShaoLin<S, Finish>::search(const TraversalRay& ray, RayCounters& counters) const -> Found {
  Found best;
  const std::optional<BoxRay> box_ray = bvh_.enter(ray);
  if (!box_ray) return best;
  double far = ray.far;
  float box_far = box_ray->local(far);
  bvh_.traverse(
      *box_ray, [&] { return box_far; },
      [&](int primitive) {
        const StartPatch& start = start_patch(primitive);
        if (!box_ray->meets(start.box, box_far)) return false;
        Search search(ray, *box_ray, start.normal, far, counters);
        descend<query>(start.root, search);
        if (!search.found) return false;
        const auto [face, sub] = primitives_[static_cast<std::size_t>(primitive)];
        best = {search.found, search.hit, face, sub};
        far = search.far;
        box_far = search.box_far;
        return query == Query::any;
      });
  return best;
}

template <Scheme S, template <class> class Finish>
bool ShaoLin<S, Finish>::occluded(const Ray& ray, RayCounters& counters) const {
  return search<Query::any>(TraversalRay(ray), counters).node != nullptr;
}

template <Scheme S, template <class> class Finish>
std::optional<Hit> ShaoLin<S, Finish>::intersect(const Ray& ray, RayCounters& counters) const {
  const TraversalRay traversal(ray);
  const Found found = search<Query::closest>(traversal, counters);
  if (!found.node) return {};
  const Parameter at = Domain<S::face_kind>::nearest(found.node->to_root(found.hit.at));
  Hit hit;
  hit.t = std::clamp(traversal.t(found.hit.distance), ray.tmin, ray.tmax);
  hit.at = {found.face, found.sub, at.x(), at.y()};
  hit.level = found.node->level();
  hit.sample = sample(found, hit.at);
  return hit;
}

/// The surface at a hit: from the polynomial where it is as good as evaluation from the control face, that is, unless
/// the piece is so small that differences of its absolute coordinates lose the normal's digits.
template <Scheme S, template <class> class Finish>
LimitSample ShaoLin<S, Finish>::sample(const Found& found, const SurfaceParameter& at) const {
  constexpr int deepest_absolute = 8;
  const bool regular = found.node->is_regular();
  if (regular && found.node->level() <= deepest_absolute && !surface_.control_mesh().is_collapsed(at.face))
    return polynomial_sample(found);
  // The position stays the node's own: near u or v = 1 parameters are too coarse to find it again.
  LimitSample sample = *surface_.evaluate(at);
  if (regular) {
    sample.position = found.node->regular().template bezier<Regular>().position(found.hit.at);
  } else if (!found.node->is_leaf()) {
    sample.position = found.node->irregular().points.front();
  }
  return sample;
}

template <Scheme S, template <class> class Finish>
SHAOLIN_FLATTEN LimitSample ShaoLin<S, Finish>::polynomial_sample(const Found& found) {
  const double scale = found.node->scale();  // plus or minus 2^-level
  return detail::sample(found.node->regular().template bezier<Regular>(), found.hit.at, Vec3::Zero(),
                        {std::copysign(1.0, scale), -std::ilogb(scale), 0});
}

/// RP and CP tests of a patch's control points, then its shadow list: the children that the ray's box test leaves,
/// front to back. A patch that is split already has been through the tests for another ray; its children's boxes are
/// quicker to ask. So that this changes no answer, the tests here pass whatever a leaf's may pass: twice its error.
template <Scheme S, template <class> class Finish>
template <Query query>
void ShaoLin<S, Finish>::descend(const Node& node, Search& search) const {
  if (node.is_leaf()) return finish(node, search);

  const typename Node::Children* children = node.known_children();
  if (!children || node.is_tiny()) {
    ++search.counters.hull_tests;
    const Box hull =
        node.is_regular()
            ? search.frame().hull(node.regular())
            : search.frame().hull(node.irregular().points).expanded(node.irregular().configuration->hull_expansion());
    const Vec3 &low = hull.lower, &high = hull.upper;
    const double error = search.frame().error(node.box());
    if (low.x() > 2 * error || high.x() < -2 * error || low.y() > 2 * error || high.y() < -2 * error) return;
    // Around an irregular corner patches shrink without end; one that lies within rounding of the ray is a point.
    if (node.is_tiny() && std::max({high.x(), -low.x(), high.y(), -low.y()}) <= 4 * error &&
        high.z() - low.z() <= 64 * error)
      return finish_irregular(node, hull, search);
    // Where patches shrink by 0.93 a level or less, rounding error is reached in as many levels.
    constexpr int most_levels = 500;
    if (node.level() >= most_levels)
      throw InputError("a patch does not shrink to a point in " + std::to_string(most_levels) +
                       " levels: the masks of the scheme do not converge; see 'shaolin scheme check'");
    children = &node.children(bvh_.space(), totals_);
  }

  const BoxOrder shadow_list(children->boxes, search.box_ray, search.box_far);
  for (std::size_t i = 0; i < shadow_list.count() && shadow_list.distance(i) <= search.box_far; ++i) {
    descend<query>(children->nodes[shadow_list.box(i)], search);
    if (query == Query::any && search.found) return;
  }
}

template <Scheme S, template <class> class Finish>
void ShaoLin<S, Finish>::finish(const Node& node, Search& search) const {
  if (!node.is_regular()) return finish_by_refinement(node, search);
  Net projected;
  search.frame().project(node.regular(), projected);
  const bool far_is_hit = search.far < search.ray.far;
  Finish<Regular> solver(search.frame().error(node.box()), search.ray.near, search.far, far_is_hit, search.counters);
  if (solver.solve(projected)) search.take(node, solver.hit());
}

/// Masks with negative weights amplify rounding: by as much as their limit functions' absolute values sum to, a level;
/// four times the polynomials' error covers the 50 levels of a sum of 2.
template <Scheme S, template <class> class Finish>
void ShaoLin<S, Finish>::finish_by_refinement(const Node& node, Search& search) const {
  Patch<S> projected = node.irregular();
  for (Vec3& point : projected.points) point = search.frame().project(point);
  const bool far_is_hit = search.far < search.ray.far;
  RefiningFinish<S> solver(4 * search.frame().error(node.box()), search.ray.near, search.far, far_is_hit,
                           search.counters);
  if (solver.solve(projected)) search.take(node, solver.hit());
}

/// The whole patch is one point to within rounding: the irregular corner's limit.
template <Scheme S, template <class> class Finish>
void ShaoLin<S, Finish>::finish_irregular(const Node& node, const Box& hull, Search& search) const {
  const double error = search.frame().error(node.box());
  if (hull.upper.z() < search.ray.near - error) return;
  const double distance = std::max(search.frame().project(node.irregular().points.front()).z(), search.ray.near);
  if (distance > search.far - (search.far < search.ray.far ? error : 0)) return;
  search.take(node, {Domain<S::face_kind>::centre(), distance});
}

}  // namespace shaolin
