#pragma once
/// A point that two surfaces have in common, if there is one.
#include "cell_frame.h"
#include "counters.h"

namespace shaolin {

/// Branch and bound over pairs of cells, one of each surface, the nearest first. A pair is dropped if a plane separates
/// the two, to within rounding as for shapes (shape_probe.h): across the way between them, along the one's tangent
/// plane or the other's, along a side of a box. Otherwise Newton's steps look for a common point: three equations for
/// four parameters, solved by the shortest step. What neither settles is split, the larger of the two.
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
  bool is_apart(const Pair& pair, const Vec3& way) const;
  bool is_apart_along_sides(const Pair& pair) const;
  /// Steps towards each other; true once the two are one point.
  bool approach(const Pair& pair, FramedSample& a, FramedSample& b) const;

  const CellFrame &a_, &b_;
  double error_;
  RayCounters& counters_;
  std::optional<Found> found_;
};

}  // namespace shaolin
