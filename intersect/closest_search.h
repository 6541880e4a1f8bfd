#pragma once
/// The closest place of start patches: through the parts that rays use, too, to the finishes at their leaves.
#include "nearest_finish.h"
#include "nearest_queue.h"
#include "nearest_refining_finish.h"
#include "parts.h"

namespace shaolin {

/// Branch and bound over patches and their parts, the nearest box first. Polynomials are not cut further, as they are
/// for rays: what their finish needs of them it makes on its own. Which parts are asked depends on the query alone, not
/// on what other queries have made.
template <Scheme S>
class ClosestSearch {
  using Polynomial = RegularPatch<S::face_kind>;
  using D = Domain<S::face_kind>;

 public:
  ClosestSearch(PointApproach& approach, TreeTotals& totals) : approach_(approach), totals_(totals) {}

  /// The nearest place: in a patch's parameters, and the level of the piece that holds it. Without a patch the place is
  /// a corner of the start patch's domain.
  struct Found {
    int primitive;  ///< which start patch
    const PatchNode<S>* patch;
    Parameter at;
    int level;
  };

  /// Puts a start patch on the list; `slot` is that of its parts.
  void add(int primitive, const PatchNode<S>& patch, typename Parts<S>::Slot& slot, const SceneBox& box) {
    queue_.push(approach_.box_point().distance(box), {primitive, &patch, 0, &slot, false});
  }
  /// Looks at all on the list that may be nearer than `distance` (in the units of boxes) and than what is found.
  void run(float distance) {
    while (!queue_.empty() && queue_.distance() <= std::min(distance, approach_.box_limit())) ask(queue_.pop());
  }
  const std::optional<Found>& found() const { return found_; }

 private:
  /// A patch, or a piece of a polynomial one.
  struct Part {
    int primitive;
    const PatchNode<S>* patch;
    int piece;  ///< as in Parts
    typename Parts<S>::Slot* slot;
    bool is_tiny;
  };

  void ask(const Part& part);
  void ask_parts(const Part& part);
  void finish(const Part& part);
  bool may_be_nearer(const Part& part);
  void take_corner(const Part& part, double error);
  double error_of(const Box& hull, const Part& part) const;

  PointApproach& approach_;
  TreeTotals& totals_;
  NearestQueue<Part> queue_;
  std::optional<Found> found_;
};

template <Scheme S>
void ClosestSearch<S>::ask(const Part& part) {
  if (part.patch->is_polynomial() || part.patch->is_leaf())
    finish(part);
  else if (may_be_nearer(part))
    ask_parts(part);
}

template <Scheme S>
void ClosestSearch<S>::ask_parts(const Part& part) {
  const Parts<S>& parts = Parts<S>::of(*part.patch, *part.slot, approach_.space, totals_);
  alignas(32) std::array<float, 8> entries;
  std::size_t first = 0;
  for (const EightBoxes* boxes : {&parts.first(), parts.second()}) {
    if (!boxes) continue;
    for (unsigned met = approach_.box_point().meet(*boxes, approach_.box_limit(), entries); met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      const typename Parts<S>::Part of = parts.part(first + i);
      queue_.push(entries[i], {part.primitive, &of.patch, of.piece, of.parts, of.is_tiny});
    }
    first += 8;
  }
}

/// The limit lies in the hull of the points, expanded. A plane across the way to the nearest place so far shows best
/// that none of it is nearer; if it is elsewhere, one across the way to the patch. Around an irregular corner patches
/// shrink without end: the corner itself is asked, and then nothing is nearer by more than the error once they are
/// small enough.
template <Scheme S>
bool ClosestSearch<S>::may_be_nearer(const Part& part) {
  const auto& patch = static_cast<const IrregularPatch<S>&>(*part.patch);
  ++approach_.counters.hull_tests;
  Box box;
  for (const Vec3& point : patch.patch().points) box.add(approach_.relative(point));
  const double error = error_of(box, part);
  if (part.is_tiny) {
    take_corner(part, error);
    // The point is the corner, as far as that is known.
    if (approach_.limit(approach_.length(patch.place().rounding())) < 0) return false;
  }
  const double limit = approach_.limit(error), expansion = patch.patch().configuration->hull_expansion();
  if (limit < 0) return false;
  for (const Vec3& way : {approach_.toward(), box.centre()}) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& point : patch.patch().points) {
      const double along = way.dot(approach_.relative(point));
      low = std::min(low, along);
      high = std::max(high, along);
    }
    if (expansion > 0) low -= expansion * (high - low);
    if (low > limit * way.norm()) return false;
  }
  // As in ExactFinish.
  constexpr int most_levels = 500;
  if (patch.place().level() >= most_levels)
    throw InputError("a patch does not shrink to a point in " + std::to_string(most_levels) +
                     " levels: the masks of the scheme do not converge; see 'shaolin scheme check'");
  return true;
}

/// The error of distances from a part with this hull. In one that is as small as its points are uncertain there is
/// nothing to tell apart: rounding has collapsed it to a few points, and its shape is an accident.
template <Scheme S>
double ClosestSearch<S>::error_of(const Box& hull, const Part& part) const {
  const double uncertain = approach_.length(part.patch->place().rounding());
  const bool is_point = (hull.upper - hull.lower).maxCoeff() <= uncertain;
  return approach_.error(hull.largest_coordinate()) + (is_point ? uncertain : 0);
}

template <Scheme S>
void ClosestSearch<S>::take_corner(const Part& part, double error) {
  const auto& patch = static_cast<const IrregularPatch<S>&>(*part.patch);
  const Parameter corner = D::nearest(patch.place().domain()(D::centre())).array().round();
  for (const auto& [u, v] : D::corners) {
    if (corner != patch.place().domain()({u, v})) continue;
    const LimitSample sample = evaluate(patch.patch(), Parameter(u, v));
    if (approach_.take(approach_.relative(sample.position), error))
      found_ = Found{part.primitive, nullptr, corner, patch.place().level()};
  }
}

template <Scheme S>
void ClosestSearch<S>::finish(const Part& part) {
  const PatchNode<S>& patch = *part.patch;
  if (!patch.is_polynomial()) {
    Patch<S> relative = static_cast<const IrregularPatch<S>&>(patch).patch();
    Box box;
    for (Vec3& point : relative.points) box.add(point = approach_.relative(point));
    // Masks with negative weights amplify rounding, see ExactFinish.
    NearestRefiningFinish<S> finish(4 * error_of(box, part), approach_);
    if (finish.solve(relative)) found_ = Found{part.primitive, &patch, finish.at(), patch.place().level()};
    return;
  }
  const int number = part.piece;
  const Pieces<Polynomial>& pieces = pieces_of<Polynomial>;
  Net whole, piece;
  approach_.relative(static_cast<const PolynomialPatch<S>&>(patch).net(), whole);
  pieces.restrict_to(number, whole.x, piece.x);
  pieces.restrict_to(number, whole.y, piece.y);
  pieces.restrict_to(number, whole.z, piece.z);
  NearestFinish<Polynomial> finish(error_of(hull_of(piece), part), approach_);
  if (!finish.solve(piece)) return;
  const SubDomain domain = Pieces<Polynomial>::domain(number);
  found_ = Found{part.primitive, &patch, domain(finish.at()), patch.place().part(domain).level()};
}

}  // namespace shaolin
