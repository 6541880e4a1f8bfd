#pragma once
/// The closest place of one start patch: through the parts that rays use, too, to the finishes at their leaves.
#include "nearest_finish.h"
#include "nearest_refining_finish.h"
#include "patch_tree.h"

namespace shaolin {

/// Branch and bound, depth first, nearest parts first. Which parts are asked depends on the query alone, not on what
/// other queries have made.
template <Scheme S>
class ClosestSearch {
  using Polynomial = RegularPatch<S::face_kind>;
  using D = Domain<S::face_kind>;

 public:
  ClosestSearch(PointApproach& approach, TreeTotals& totals) : approach_(approach), totals_(totals) {}

  /// A place that is nearer than the approach knew: in a patch's parameters, and the level of the piece that holds it.
  /// Without a patch the place is a corner of the start patch's domain.
  struct Found {
    const PatchNode<S>* patch;
    Parameter at;
    int level;
  };

  /// Looks through a patch; `slot` holds its parts.
  void search(const PatchNode<S>& patch, typename Parts<S>::Slot& slot) {
    if (patch.is_leaf())
      finish(patch, 0);
    else
      descend(patch, slot, false);
  }
  const std::optional<Found>& found() const { return found_; }

 private:
  void descend(const PatchNode<S>& patch, typename Parts<S>::Slot& slot, bool is_tiny);
  void finish(const PatchNode<S>& patch, int piece);
  bool may_be_nearer(const IrregularPatch<S>& patch, bool is_tiny);
  void take_corner(const IrregularPatch<S>& patch, double error);

  PointApproach& approach_;
  TreeTotals& totals_;
  std::optional<Found> found_;
};

template <Scheme S>
void ClosestSearch<S>::descend(const PatchNode<S>& patch, typename Parts<S>::Slot& slot, bool is_tiny) {
  if (!patch.is_polynomial() && !may_be_nearer(static_cast<const IrregularPatch<S>&>(patch), is_tiny)) return;
  const Parts<S>& parts = Parts<S>::of(patch, slot, approach_.space, totals_);
  BoxOrder order(parts.first().boxes, approach_.box_point(), approach_.box_limit());
  if (parts.second()) order.add(parts.second()->boxes, 8, approach_.box_point(), approach_.box_limit());
  for (std::size_t i = 0; i < order.count() && order.distance(i) <= approach_.box_limit(); ++i) {
    const std::size_t box = order.box(i);
    const typename Parts<S>::Eight& eight = box < 8 ? parts.first() : *parts.second();
    const PatchNode<S>& part = *eight.patch[box % 8];
    if (const std::int8_t piece = eight.piece[box % 8]; piece >= 0)
      finish(part, piece);
    else
      descend(part, eight.parts[box % 8], piece == Parts<S>::tiny);
  }
}

/// The limit lies in the hull of the points, expanded. A plane across the way to the nearest place so far shows best
/// that none of it is nearer; if it is elsewhere, one across the way to the patch. Around an irregular corner patches
/// shrink without end: the corner itself is asked, and then nothing is nearer by more than what is uncertain about
/// their points once they are small enough.
template <Scheme S>
bool ClosestSearch<S>::may_be_nearer(const IrregularPatch<S>& patch, bool is_tiny) {
  ++approach_.counters.hull_tests;
  std::vector<Vec3> points = patch.patch().points;
  for (Vec3& point : points) point = approach_.relative(point);
  const Box box = hull_of(points);
  double error = approach_.error(box.largest_coordinate());
  if (is_tiny) {
    error += approach_.length(patch.place().rounding);
    take_corner(patch, error);
  }
  const double limit = approach_.limit(error), expansion = patch.patch().configuration->hull_expansion();
  if (limit < 0) return false;
  for (const Vec3& way : {approach_.toward(), box.centre()}) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& point : points) {
      const double along = way.dot(point);
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

template <Scheme S>
void ClosestSearch<S>::take_corner(const IrregularPatch<S>& patch, double error) {
  const Parameter corner = D::nearest(patch.place().domain(D::centre())).array().round();
  for (const auto& [u, v] : D::corners) {
    if (corner != patch.place().domain({u, v})) continue;
    const LimitSample sample = evaluate(patch.patch(), Parameter(u, v));
    if (approach_.take(approach_.relative(sample.position), error))
      found_ = Found{nullptr, corner, patch.place().level()};
  }
}

template <Scheme S>
void ClosestSearch<S>::finish(const PatchNode<S>& patch, int number) {
  if (!patch.is_polynomial()) {
    Patch<S> relative = static_cast<const IrregularPatch<S>&>(patch).patch();
    Box box;
    for (Vec3& point : relative.points) box.add(point = approach_.relative(point));
    // Masks with negative weights amplify rounding, see ExactFinish.
    NearestRefiningFinish<S> finish(4 * approach_.error(box.largest_coordinate()), approach_);
    if (finish.solve(relative)) found_ = Found{&patch, finish.at(), patch.place().level()};
    return;
  }
  const Pieces<Polynomial>& pieces = pieces_of<Polynomial>;
  Net whole, piece;
  approach_.relative(static_cast<const PolynomialPatch<S>&>(patch).net(), whole);
  pieces.restrict_to(number, whole.x, piece.x);
  pieces.restrict_to(number, whole.y, piece.y);
  pieces.restrict_to(number, whole.z, piece.z);
  NearestFinish<Polynomial> finish(approach_.error(hull_of(piece).largest_coordinate()), approach_);
  if (!finish.solve(piece)) return;
  const SubDomain domain = Pieces<Polynomial>::domain(number);
  found_ = Found{&patch, domain(finish.at()), patch.place().part(domain).level()};
}

}  // namespace shaolin
