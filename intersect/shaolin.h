#pragma once
/// ShaoLin, the shadow of the line: ray queries on the limit surface of a subdivision mesh (Mueller, Techmann, Fellner,
/// "Adaptive ray tracing of subdivision surfaces", Eurographics 2003).
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../schemes/scheme_surface.h"
#include "approach.h"
#include "bvh.h"
#include "closest_search.h"
#include "crossings.h"
#include "face_bounds.h"
#include "start_patches.h"
#include "surface_cells.h"

namespace shaolin {

/// A finish that gives all hits of a ray, too:
///     void search_all(const StartPatch&, Approach&, TreeTotals&, std::vector<Found>&) const;
/// appends them; its Found has `reach`, `is_proven` and `error` besides, as ExactFinish's.
template <class Finish>
concept FindsAll = requires {
  &Finish::search_all;
};

/// A finish whose start patches have parts (parts.h), through which the closest point is searched.
template <class Finish>
concept HasParts = requires(const typename Finish::StartPatch& start) {
  start.patch().is_polynomial();
};

/// The part of the algorithm that all finishes share: a hierarchy over the faces, and start patches, made when a ray
/// first reaches their faces. What happens inside a start patch is the finish's: ExactFinish<S> (exact_finish.h) finds
/// the limit surface to rounding error, ChordFinish<S> (chord_finish.h) is the paper's, A3Finish<S> (a3_finish.h) the
/// one that it was compared with. A Finish has
///
///     struct StartPatch;  // from (Patch<S>, level, const BoxSpace&, const Finish&, TreeTotals&)
///       const SceneBox& box() const;  // holds what search() may find
///       std::uint64_t bytes() const;  // its own; what grows in it goes to the totals when it is made
///       std::uint64_t grown_bytes() const;  // of all that has grown so far
///     struct Found { double distance; ... };
///     template <Query> bool search(const StartPatch&, Approach&, TreeTotals&, std::optional<Found>&) const;
///     Hit hit(const Found&, face, sub, const SchemeSurface<S>&) const;  // all but t and instance
///
/// where search() gives the nearest place with distance in [ray.near, far], or any, or returns false and changes
/// nothing.
template <Scheme S, template <class> class Finish>
class ShaoLin {
 public:
  /// Bounds every face (see face_bounds.h) and builds the hierarchy. O(n log n); nothing is refined yet. What rays
  /// refine is kept under the budget, if there is one. Throws InputError if a face has no finite bound.
  explicit ShaoLin(const SchemeSurface<S>& surface, const Finish<S>& finish = {},
                   const std::shared_ptr<PatchBudget>& budget = {});

  /// The hit with the least t in [tmin, tmax]. Of hits at equal distance, the face visited first wins; the order of
  /// visits depends on the ray alone. The work goes to `counters`. Throws InputError where masks turn out not to
  /// converge.
  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const;

  /// True if there is a hit in [tmin, tmax].
  bool occluded(const Ray& ray, RayCounters& counters) const;

  /// All hits with t in [tmin, tmax], see crossings.h. Of a finish that finds the limit surface itself.
  std::vector<Crossing> all_hits(const Ray& ray, RayCounters& counters) const requires FindsAll<Finish<S>>;

  /// The closest place within the query's radius, in the object's space and without a distance; empty if there is none.
  /// Of places that are equally near to rounding, the one visited first; the order of visits depends on the query
  /// alone. For finishes whose start patches have parts (exact_finish.h). Throws as intersect() does.
  std::optional<ClosestPoint> closest_point(const PointQuery& query,
                                            RayCounters& counters) const requires HasParts<Finish<S>>;

  /// The surface as one cell, null if there is none; see surface_cell.h. For finishes whose start patches have parts.
  std::unique_ptr<SurfaceCell> cells() const requires HasParts<Finish<S>>;

  /// A box that holds the surface.
  const Box& bounds() const { return bvh_.bounds(); }

  /// Adds what rays have made so far, and the memory that it takes.
  void add_to(Statistics& total) const {
    total.faces += start_patches_.size();
    total.bytes += bvh_.bytes() + primitives_.size() * sizeof(Primitive);
    start_patches_.add_to(total);
  }

 private:
  using StartPatch = typename Finish<S>::StartPatch;
  using Found = typename Finish<S>::Found;

  /// What a leaf of the hierarchy stands for: a face, or an n-gon's corner.
  struct Primitive {
    int face, sub;
  };

  struct FoundAt {
    std::optional<Found> found;
    int primitive = -1;
  };

  Primitive primitive(int number) const {
    return primitives_.empty() ? Primitive{number, 0} : primitives_[static_cast<std::size_t>(number)];
  }
  const StartPatch& start_patch(int primitive) const {
    const StartPatch* const known = start_patches_.find(static_cast<std::size_t>(primitive));
    return known ? *known : make_start_patch(primitive);
  }
  const StartPatch& make_start_patch(int primitive) const;
  /// Finishes that certify say so of what they find; of others nothing is certified.
  bool is_certified(const Found& found) const {
    if constexpr (requires { found.is_certified(surface_); })
      return found.is_certified(surface_);
    else
      return false;
  }
  template <Query query>
  FoundAt search(const Ray& ray, const TraversalRay& traversal, RayCounters& counters) const;
  /// Within the distances of `traversal`. A PatchBudget::Query must span it: what is found is in a tree.
  std::optional<Hit> closest(const Ray& ray, const TraversalRay& traversal, RayCounters& counters) const;

  const SchemeSurface<S>& surface_;
  Finish<S> finish_;
  std::vector<Primitive> primitives_;  ///< none if they are the faces
  Bvh bvh_;
  mutable StartPatches<StartPatch> start_patches_;
};

template <Scheme S, template <class> class Finish>
ShaoLin<S, Finish>::ShaoLin(const SchemeSurface<S>& surface, const Finish<S>& finish,
                            const std::shared_ptr<PatchBudget>& budget)
    : surface_(surface), finish_(finish), start_patches_(budget) {
  const SubdivisionMesh<S>& mesh = surface.mesh();
  std::vector<Box> boxes = face_bounds(mesh);
  bool are_faces = true;
  for (const int f : mesh.faces()) {
    are_faces &= mesh.has_limit(f) && surface.sub_count(f) == 1;
    const Box& box = boxes[static_cast<std::size_t>(f)];
    if (mesh.has_limit(f) && (!box.lower.allFinite() || !box.upper.allFinite()))
      throw InputError("nothing bounds the surface of face " + std::to_string(f) +
                       ": its coordinates are too large, or the masks of the scheme do not sum to one or not "
                       "converge; see 'shaolin scheme check'");
  }
  if (!are_faces) {
    const std::vector<Box> of_faces = std::move(boxes);
    boxes.clear();
    for (const int f : mesh.faces())
      for (int sub = 0; mesh.has_limit(f) && sub < surface.sub_count(f); ++sub) {
        boxes.push_back(of_faces[static_cast<std::size_t>(f)]);
        primitives_.push_back({f, sub});
      }
  }
  bvh_ = Bvh(boxes);
  start_patches_.resize(boxes.size());
}

template <Scheme S, template <class> class Finish>
auto ShaoLin<S, Finish>::make_start_patch(int primitive) const -> const StartPatch& {
  const auto [face, sub] = this->primitive(primitive);
  TreeTotals making;  // counted if no other thread is first
  auto made = std::make_unique<StartPatch>(surface_.patch(face, sub), surface_.splits_by_corner(face), bvh_.space(),
                                           finish_, making);
  return start_patches_.keep(static_cast<std::size_t>(primitive), std::move(made), making);
}

template <Scheme S, template <class> class Finish>
template <Query query>
auto ShaoLin<S, Finish>::search(const Ray& ray, const TraversalRay& traversal, RayCounters& counters) const -> FoundAt {
  FoundAt best;
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return best;
  Approach approach(traversal, *box_ray, ray.footprint, bvh_.space(), counters);
  bvh_.traverse(
      *box_ray, [&] { return approach.box_far(); },
      [&](int primitive) {
        const StartPatch& start = start_patch(primitive);
        if (!box_ray->meets(start.box(), approach.box_far())) return false;
        if (!finish_.template search<query>(start, approach, start_patches_.totals(), best.found)) return false;
        best.primitive = primitive;
        approach.shorten(best.found->distance);
        return query == Query::any;
      });
  return best;
}

template <Scheme S, template <class> class Finish>
bool ShaoLin<S, Finish>::occluded(const Ray& ray, RayCounters& counters) const {
  if (bvh_.is_passed_by(ray)) return false;
  const PatchBudget::Query guard(start_patches_.budget());
  const std::optional<Found> any = search<Query::any>(ray, TraversalRay(ray), counters).found;
  if (any && !is_certified(*any)) ++counters.uncertified;
  return any.has_value();
}

template <Scheme S, template <class> class Finish>
std::vector<Crossing> ShaoLin<S, Finish>::all_hits(const Ray& ray,
                                                   RayCounters& counters) const requires FindsAll<Finish<S>> {
  const PatchBudget::Query guard(start_patches_.budget());
  const TraversalRay traversal(ray);
  const std::optional<BoxRay> box_ray = bvh_.enter(traversal);
  if (!box_ray) return {};
  std::vector<Contact> contacts;
  std::vector<Found> found;
  Approach approach(traversal, *box_ray, ray.footprint, bvh_.space(), counters);
  bvh_.traverse(
      *box_ray, [&] { return approach.box_far(); },
      [&](int primitive) {
        const StartPatch& start = start_patch(primitive);
        if (!box_ray->meets(start.box(), approach.box_far())) return false;
        const auto [face, sub] = this->primitive(primitive);
        found.clear();
        finish_.search_all(start, approach, start_patches_.totals(), found);
        for (const Found& one : found) {
          Hit hit = finish_.hit(one, face, sub, surface_);
          hit.t = std::clamp(traversal.t(one.distance), ray.tmin, ray.tmax);
          hit.certificate.residual = distance_from_line(hit.sample.position, traversal.origin, traversal.direction);
          const double cosine = std::abs(hit.sample.normal.dot(traversal.direction));
          const double uncertainty = contact_uncertainty(one.error, one.reach, cosine);
          // (A cell that is a point to within rounding reaches 64 errors at most.)
          contacts.push_back({hit, one.distance, uncertainty, one.error, one.is_proven, one.reach > 64 * one.error});
        }
        return false;
      });
  const auto closest_between = [&](double begin, double end) {
    TraversalRay part = traversal;
    part.near = std::max(part.near, begin);
    part.far = std::min(part.far, end);
    return closest(ray, part, counters);
  };
  return crossings(std::move(contacts), surface_, traversal.direction, closest_between);
}

template <Scheme S, template <class> class Finish>
std::optional<Hit> ShaoLin<S, Finish>::intersect(const Ray& ray, RayCounters& counters) const {
  if (bvh_.is_passed_by(ray)) return {};
  const PatchBudget::Query guard(start_patches_.budget());
  return closest(ray, TraversalRay(ray), counters);
}

template <Scheme S, template <class> class Finish>
std::optional<Hit> ShaoLin<S, Finish>::closest(const Ray& ray, const TraversalRay& traversal,
                                               RayCounters& counters) const {
  const FoundAt best = search<Query::closest>(ray, traversal, counters);
  if (!best.found) return {};
  const auto [face, sub] = primitive(best.primitive);
  Hit hit = finish_.hit(*best.found, face, sub, surface_);
  hit.t = std::clamp(traversal.t(best.found->distance), ray.tmin, ray.tmax);
  hit.certificate.residual = distance_from_line(hit.sample.position, traversal.origin, traversal.direction);
  return hit;
}

template <Scheme S, template <class> class Finish>
std::optional<ClosestPoint> ShaoLin<S, Finish>::closest_point(
    const PointQuery& query, RayCounters& counters) const requires HasParts<Finish<S>> {
  const PatchBudget::Query guard(start_patches_.budget());
  if (start_patches_.size() == 0) return {};
  PointApproach approach(query, bvh_.bounds(), bvh_.space(), counters);
  ClosestSearch<S> search(approach, start_patches_.totals());
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
  const auto [face, sub] = primitive(best->primitive);
  ClosestPoint closest;
  closest.level = best->level;
  if (best->patch) {
    const Hit hit = finish_.hit(Found{best->patch, best->at, 0, 0}, face, sub, surface_);
    closest.at = hit.at;
    closest.sample = hit.sample;
  } else {
    closest.at = {face, sub, best->at.x(), best->at.y()};
    closest.sample = *surface_.evaluate(closest.at);
  }
  return closest;
}

template <Scheme S, template <class> class Finish>
std::unique_ptr<SurfaceCell> ShaoLin<S, Finish>::cells() const requires HasParts<Finish<S>> {
  if (start_patches_.size() == 0) return {};
  const auto leaf = [this](int primitive) -> typename CellSource<S>::Leaf {
    const auto [face, sub] = this->primitive(primitive);
    return {face, sub};
  };
  const auto start = [this](int primitive) -> typename CellSource<S>::Start {
    const StartPatch& made = start_patch(primitive);
    return {made.patch(), made.parts()};
  };
  return std::make_unique<HierarchyCell<S>>(
      std::make_shared<const CellSource<S>>(start_patches_.budget(), bvh_, start_patches_.totals(), leaf, start));
}

}  // namespace shaolin
