#pragma once
/// The exact finish: patches are split until a Newton iteration on the limit surface is safe. It goes beyond the paper:
/// hits are on the limit surface to rounding error, so no gap polygon and no W-case can arise.
#include <optional>

#include "../schemes/scheme_surface.h"
#include "approach.h"
#include "chord_plane.h"
#include "flatten.h"
#include "newton_finish.h"
#include "patch_tree.h"
#include "ray_frame.h"
#include "refining_finish.h"

namespace shaolin {

/// A Finish of ShaoLin (see shaolin.h). Patches are dropped on proof only: by their boxes, and by the hulls of their
/// control points against RP and CP, which hold the limit.
template <Scheme S>
class ExactFinish {
  using Node = PatchNode<S>;
  using Regular = RegularPatch<S::face_kind>;

 public:
  /// The patch of a face, or of an n-gon's corner, its own box, which is tighter than the face's in the hierarchy, and
  /// the normal of its plane TP.
  class StartPatch {
   public:
    StartPatch(Patch<S> patch, int level, const BoxSpace& space, const ExactFinish&, TreeTotals& totals)
        : normal_(plane_normal(patch)), root_(std::move(patch), level, space, totals), box_(root_.box(), space) {}

    const SceneBox& box() const { return box_; }
    const Node& root() const { return root_; }
    const Vec3& normal() const { return normal_; }
    std::uint64_t bytes() const { return root_.own_bytes(); }

   private:
    Vec3 normal_;
    Node root_;
    SceneBox box_;
  };

  /// A place in a node's parameters, met at a distance along the ray.
  struct Found {
    const Node* node;
    Parameter at;
    double distance;
  };

  template <Query query>
  std::optional<Found> search(const StartPatch& start, const Approach& approach, TreeTotals& totals) const {
    Search search(start.normal(), approach, totals);
    search.template descend<query>(start.root());
    return search.found;
  }

  Hit hit(const Found& found, int face, int sub, const SchemeSurface<S>& surface) const {
    const Parameter at = Domain<S::face_kind>::nearest(found.node->to_root(found.at));
    Hit hit;
    hit.at = {face, sub, at.x(), at.y()};
    hit.level = found.node->level();
    hit.sample = sample(found, hit.at, surface);
    return hit;
  }

 private:
  /// A ray on its way through one start patch.
  class Search {
   public:
    Search(const Vec3& normal, const Approach& approach, TreeTotals& totals)
        : plane_normal_(normal), approach_(approach), totals_(totals) {}

    template <Query query>
    void descend(const Node& node);

    std::optional<Found> found;

   private:
    void finish(const Node& node);
    void finish_by_refinement(const Node& node);
    void finish_irregular(const Node& node, const Box& hull);

    /// The ray's frame, made when a patch first asks: most rays miss the boxes of most patches.
    const RayFrame& frame() {
      if (!frame_) frame_.emplace(approach_.ray, plane_normal_);
      return *frame_;
    }

    /// The nearest hit so far.
    void take(const Node& node, const PatchHit& nearest) {
      found = Found{&node, nearest.at, nearest.distance};
      approach_.shorten(nearest.distance);
    }

    const Vec3& plane_normal_;
    Approach approach_;
    TreeTotals& totals_;
    std::optional<RayFrame> frame_;
  };

  static LimitSample sample(const Found& found, const SurfaceParameter& at, const SchemeSurface<S>& surface);
  static LimitSample polynomial_sample(const Found& found);
};

/// The surface at a hit: from the polynomial where it is as good as evaluation from the control face, that is, unless
/// the piece is so small that differences of its absolute coordinates lose the normal's digits.
template <Scheme S>
LimitSample ExactFinish<S>::sample(const Found& found, const SurfaceParameter& at, const SchemeSurface<S>& surface) {
  constexpr int deepest_absolute = 8;
  const bool regular = found.node->is_regular();
  if (regular && found.node->level() <= deepest_absolute) return polynomial_sample(found);
  // The position stays the node's own: near u or v = 1 parameters are too coarse to find it again.
  LimitSample sample = *surface.evaluate(at);
  if (regular) {
    sample.position = found.node->regular().template bezier<Regular>().position(found.at);
  } else if (!found.node->is_leaf()) {
    sample.position = found.node->irregular().points.front();
  }
  return sample;
}

template <Scheme S>
SHAOLIN_FLATTEN LimitSample ExactFinish<S>::polynomial_sample(const Found& found) {
  return detail::sample(found.node->regular().template bezier<Regular>(), found.at, Vec3::Zero(),
                        1 / found.node->scale(), 1);
}

/// RP and CP tests of a patch's control points, then its shadow list: the children that the ray's box test leaves,
/// front to back. A patch that is split already has been through the tests for another ray; its children's boxes are
/// quicker to ask. So that this changes no answer, the tests here pass whatever a leaf's may pass: twice its error.
template <Scheme S>
template <Query query>
void ExactFinish<S>::Search::descend(const Node& node) {
  if (node.is_leaf()) return finish(node);

  const typename Node::Children* children = node.known_children();
  if (!children || node.is_tiny()) {
    ++approach_.counters.hull_tests;
    const Box hull =
        node.is_regular()
            ? frame().hull(node.regular())
            : frame().hull(node.irregular().points).expanded(node.irregular().configuration->hull_expansion());
    const Vec3 &low = hull.lower, &high = hull.upper;
    const double error = frame().error(node.box());
    if (low.x() > 2 * error || high.x() < -2 * error || low.y() > 2 * error || high.y() < -2 * error) return;
    // Around an irregular corner patches shrink without end; one that lies within rounding of the ray is a point.
    if (node.is_tiny() && std::max({high.x(), -low.x(), high.y(), -low.y()}) <= 4 * error &&
        high.z() - low.z() <= 64 * error)
      return finish_irregular(node, hull);
    // Where patches shrink by 0.93 a level or less, rounding error is reached in as many levels.
    constexpr int most_levels = 500;
    if (node.level() >= most_levels)
      throw InputError("a patch does not shrink to a point in " + std::to_string(most_levels) +
                       " levels: the masks of the scheme do not converge; see 'shaolin scheme check'");
    children = &node.children(approach_.space, totals_);
  }

  const BoxOrder shadow_list(children->boxes, approach_.box_ray, approach_.box_far());
  for (std::size_t i = 0; i < shadow_list.count() && shadow_list.distance(i) <= approach_.box_far(); ++i) {
    descend<query>(children->nodes[shadow_list.box(i)]);
    if (query == Query::any && found) return;
  }
}

template <Scheme S>
void ExactFinish<S>::Search::finish(const Node& node) {
  if (!node.is_regular()) return finish_by_refinement(node);
  Net projected;
  frame().project(node.regular(), projected);
  NewtonFinish<Regular> solver(frame().error(node.box()), approach_.ray.near, approach_.far(), approach_.far_is_hit(),
                               approach_.counters);
  if (solver.solve(projected)) take(node, solver.hit());
}

/// Masks with negative weights amplify rounding: by as much as their limit functions' absolute values sum to, a level;
/// four times the polynomials' error covers the 50 levels of a sum of 2.
template <Scheme S>
void ExactFinish<S>::Search::finish_by_refinement(const Node& node) {
  Patch<S> projected = node.irregular();
  for (Vec3& point : projected.points) point = frame().project(point);
  RefiningFinish<S> solver(4 * frame().error(node.box()), approach_.ray.near, approach_.far(), approach_.far_is_hit(),
                           approach_.counters);
  if (solver.solve(projected)) take(node, solver.hit());
}

/// The whole patch is one point to within rounding: the irregular corner's limit.
template <Scheme S>
void ExactFinish<S>::Search::finish_irregular(const Node& node, const Box& hull) {
  const double error = frame().error(node.box());
  if (hull.upper.z() < approach_.ray.near - error) return;
  const double distance = std::max(frame().project(node.irregular().points.front()).z(), approach_.ray.near);
  if (distance > approach_.far() - (approach_.far_is_hit() ? error : 0)) return;
  take(node, {Domain<S::face_kind>::centre(), distance});
}

}  // namespace shaolin
