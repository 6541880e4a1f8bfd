#pragma once
/// A point that two surfaces have in common, if there is one.
#include "cell_frame.h"
#include "counters.h"

namespace shaolin {

/// Branch and bound over pairs of cells, one of each surface, those with the nearest places first. A pair is dropped if
/// a plane separates the hulls of the two, to within rounding as for shapes (shape_probe.h); where edges cross at a
/// distance only planes close to both do, which separation.h finds. Otherwise steps of Newton's kind look for a common
/// point: three equations for four parameters, solved by the shortest step, or by the one that leaves least, and inside
/// of both cells, so that edges and corners that just touch are found, too. What neither settles is split, the larger
/// of the two.
class PairSearch {
 public:
  /// A place of each surface; they are one point, to rounding.
  struct Found {
    const SurfaceCell *a, *b;
    FramedSample on_a, on_b;
  };

  /// Both frames are of one query.
  PairSearch(const CellFrame& a, const CellFrame& b, RayCounters& counters)
      : a_(a), b_(b), error_(a.error() + b.error()), counters_(counters) {}

  std::optional<Found> run(SurfaceCell& a, SurfaceCell& b);

 private:
  struct Pair {
    SurfaceCell *a, *b;
  };

  /// The rank of a pair that may have a common point. Sets found_ if it is found.
  std::optional<double> look(const Pair& pair);
  /// True if a plane separates the two; one across the way from b to a is tried first.
  bool is_apart(const Pair& pair, const Vec3& way) const;
  /// Steps towards each other; true once the two are one point.
  bool approach(const Pair& pair, FramedSample& a, FramedSample& b) const;

  const CellFrame &a_, &b_;
  double error_;
  RayCounters& counters_;
  std::optional<Found> found_;
};

}  // namespace shaolin
