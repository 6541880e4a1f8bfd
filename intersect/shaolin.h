#pragma once
/// ShaoLin, the shadow of the line: ray queries on the limit surface of a subdivision mesh (Mueller, Techmann, Fellner,
/// "Adaptive ray tracing of subdivision surfaces", Eurographics 2003).
#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../schemes/scheme_surface.h"
#include "approach.h"
#include "bvh.h"
#include "closest_search.h"
#include "face_bounds.h"
#include "tree_totals.h"

namespace shaolin {

/// The part of the algorithm that all finishes share: a hierarchy over the faces, and start patches, made when a ray
/// first reaches their faces. What happens inside a start patch is the finish's: ExactFinish<S> (exact_finish.h) finds
/// the limit surface to rounding error, ChordFinish<S> (chord_finish.h) is the paper's, A3Finish<S> (a3_finish.h) the
/// one that it was compared with. A Finish has
///
///     struct StartPatch;  // from (Patch<S>, level, const BoxSpace&, const Finish&, TreeTotals&)
///       const SceneBox& box() const;  // holds what search() may find
///       std::uint64_t bytes() const;  // its own; what grows later goes to the totals
///     struct Found { double distance; ... };
///     template <Query> std::optional<Found> search(const StartPatch&, Approach&, TreeTotals&) const;
///     Hit hit(const Found&, face, sub, const SchemeSurface<S>&) const;  // all but t and instance
///
/// where search() gives the nearest place with distance in [ray.near, far], or any.
template <Scheme S, template <class> class Finish>
class ShaoLin {
 public:
  /// Bounds every face (see face_bounds.h) and builds the hierarchy. O(n log n); nothing is refined yet. Throws
  /// InputError if a face has no finite bound.
  explicit ShaoLin(const SchemeSurface<S>& surface, const Finish<S>& finish = {});
  ~ShaoLin() {
    for (auto& slot : start_patches_) delete slot.load();
  }
  ShaoLin(const ShaoLin&) = delete;
  ShaoLin& operator=(const ShaoLin&) = delete;

  /// The hit with the least t in [tmin, tmax]. Of hits at equal distance, the face visited first wins; the order of
  /// visits depends on the ray alone. The work goes to `counters`. Throws InputError where masks turn out not to
  /// converge.
  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const;

  /// True if there is a hit in [tmin, tmax].
  bool occluded(const Ray& ray, RayCounters& counters) const;

  /// The closest place within the query's radius, in the object's space and without a distance; empty if there is none.
  /// Of places that are equally near to rounding, the one visited first; the order of visits depends on the query
  /// alone. For finishes whose start patches have parts (exact_finish.h). Throws as intersect() does.
  std::optional<ClosestPoint> closest_point(const PointQuery& query, RayCounters& counters) const requires
      requires(const typename Finish<S>::StartPatch& start) {
    start.patch();
  };

  /// A box that holds the surface.
  const Box& bounds() const { return bvh_.bounds(); }

  /// Adds what rays have made so far, and the memory that it takes.
  void add_to(Statistics& total) const {
    total.faces += primitives_.size();
    total.faces_touched += faces_touched_;
    total.patches_split += totals_.patches_split;
    total.invalid_patches += totals_.invalid_patches;
    total.unresolved_patches += totals_.unresolved_patches;
    total.bytes +=
        totals_.bytes + bvh_.bytes() + primitives_.size() * (sizeof(Primitive) + sizeof(std::atomic<StartPatch*>));
  }

 private:
  using StartPatch = typename Finish<S>::StartPatch;
  using Found = typename Finish<S>::Found;

  /// What a leaf of the hierarchy stands for: a face, or an n-gon's corner.
  struct Primitive {
    int face, sub;
  };

  struct FoundAt {
    Found found;
    Primitive primitive;
  };

  const StartPatch& start_patch(int primitive) const {
    const StartPatch* known = start_patches_[static_cast<std::size_t>(primitive)].load(std::memory_order_acquire);
    return known ? *known : make_start_patch(primitive);
  }
  const StartPatch& make_start_patch(int primitive) const;
  template <Query query>
  std::optional<FoundAt> search(const Ray& ray, const TraversalRay& traversal, RayCounters& counters) const;

  const SchemeSurface<S>& surface_;
  Finish<S> finish_;
  std::vector<Primitive> primitives_;
  Bvh bvh_;
  mutable std::vector<std::atomic<StartPatch*>> start_patches_;
  mutable TreeTotals totals_;
  mutable std::atomic<std::uint64_t> faces_touched_{0};
};

template <Scheme S, template <class> class Finish>
ShaoLin<S, Finish>::ShaoLin(const SchemeSurface<S>& surface, const Finish<S>& finish)
    : surface_(surface), finish_(finish) {
  const SubdivisionMesh<S>& mesh = surface.mesh();
  const std::vector<Box> bounds = face_bounds(mesh);
  std::vector<Box> boxes;
  for (const int f : mesh.faces()) {
    if (!mesh.has_limit(f)) continue;
    const Box box = bounds[static_cast<std::size_t>(f)].with_rounding();
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

template <Scheme S, template <class> class Finish>
auto ShaoLin<S, Finish>::make_start_patch(int primitive) const -> const StartPatch& {
  const auto [face, sub] = primitives_[static_cast<std::size_t>(primitive)];
  TreeTotals made_totals;  // counted if no other thread is first
  auto made = std::make_unique<StartPatch>(surface_.patch(face, sub), surface_.splits_by_corner(face), bvh_.space(),
                                           finish_, made_totals);
  std::atomic<StartPatch*>& slot = start_patches_[static_cast<std::size_t>(primitive)];
  StartPatch* expected = nullptr;
  if (!slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  made_totals.bytes += sizeof(StartPatch) + made->bytes();
  totals_.add(made_totals);
  ++faces_touched_;
  return *made.release();
}

template <Scheme S, template <class> class Finish>
template <Query query>
auto ShaoLin<S, Finish>::search(const Ray& ray, const TraversalRay& traversal, RayCounters& counters) const
    -> std::optional<FoundAt> {
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return {};
  std::optional<FoundAt> best;
  Approach approach(traversal, *box_ray, ray.footprint, bvh_.space(), counters);
  bvh_.traverse(
      *box_ray, [&] { return approach.box_far(); },
      [&](int primitive) {
        const StartPatch& start = start_patch(primitive);
        if (!box_ray->meets(start.box(), approach.box_far())) return false;
        const std::optional<Found> found = finish_.template search<query>(start, approach, totals_);
        if (!found) return false;
        best = {*found, primitives_[static_cast<std::size_t>(primitive)]};
        approach.shorten(found->distance);
        return query == Query::any;
      });
  return best;
}

template <Scheme S, template <class> class Finish>
bool ShaoLin<S, Finish>::occluded(const Ray& ray, RayCounters& counters) const {
  return search<Query::any>(ray, TraversalRay(ray), counters).has_value();
}

template <Scheme S, template <class> class Finish>
std::optional<Hit> ShaoLin<S, Finish>::intersect(const Ray& ray, RayCounters& counters) const {
  const TraversalRay traversal(ray);
  const std::optional<FoundAt> best = search<Query::closest>(ray, traversal, counters);
  if (!best) return {};
  Hit hit = finish_.hit(best->found, best->primitive.face, best->primitive.sub, surface_);
  hit.t = std::clamp(traversal.t(best->found.distance), ray.tmin, ray.tmax);
  return hit;
}

template <Scheme S, template <class> class Finish>
std::optional<ClosestPoint> ShaoLin<S, Finish>::closest_point(const PointQuery& query,
                                                              RayCounters& counters) const requires
    requires(const typename Finish<S>::StartPatch& start) {
  start.patch();
}
{
  if (primitives_.empty()) return {};
  PointApproach approach(query, bvh_.bounds(), bvh_.space(), counters);
  ClosestSearch<S> search(approach, totals_);
  bvh_.nearest_first(
      approach.box_point(), [&] { return approach.box_limit(); },
      [&](int primitive, float distance) {
        search.run(distance);
        if (distance > approach.box_limit()) return;
        const StartPatch& start = start_patch(primitive);
        search.add(primitive, start.patch(), start.parts(), start.box());
      });
  search.run(std::numeric_limits<float>::infinity());
  const auto& best = search.found();
  if (!best) return {};
  const auto [face, sub] = primitives_[static_cast<std::size_t>(best->primitive)];
  ClosestPoint closest;
  closest.level = best->level;
  if (best->patch) {
    const Hit hit = finish_.hit(Found{best->patch, best->at, best->level, 0}, face, sub, surface_);
    closest.at = hit.at;
    closest.sample = hit.sample;
  } else {
    closest.at = {face, sub, best->at.x(), best->at.y()};
    closest.sample = *surface_.evaluate(closest.at);
  }
  return closest;
}

}  // namespace shaolin
