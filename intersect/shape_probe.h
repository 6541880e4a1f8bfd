#pragma once
/// Whether a cell of a surface and a convex shape have a point in common.
#include "cell_frame.h"
#include "counters.h"

namespace shaolin {

/// Answers for certain that a cell keeps clear of a shape, by a plane between the two; or finds a place of the cell
/// that the shape holds, by Newton's steps; or neither, and then its parts are to be asked.
///
/// The cell lies on one side of a plane if its lower bound along the normal exceeds the shape's reach. Across a surface
/// that bound is off by the square of the cell's size. So where the two touch, or just fail to, only a few cells a
/// level stay open, down to those whose squares are rounding.
class ShapeProbe {
 public:
  ShapeProbe(const Convex& shape, const CellFrame& frame, RayCounters& counters)
      : shape_(shape), frame_(frame), counters_(counters) {}

  enum class Verdict { apart, open, met };
  struct Answer {
    Verdict verdict;
    double distance;                    ///< from the shape, of the nearest place that was looked at, or of the middle
    std::optional<FramedSample> place;  ///< that place; what the shape holds where `met`
  };

  /// Apart are those with a gap above `margin`; met is what comes to within twice the error, which what is not apart
  /// may be away.
  Answer operator()(const SurfaceCell& cell, double margin) const;

  /// True if a plane across a way keeps the cell off the shape, by more than the margin, on the way's side. The way
  /// need not be unit; if it is zero there is no plane.
  bool is_apart(const SurfaceCell& cell, const Vec3& way, double margin) const;

  /// A shape's point that is nearest to a given one, for a contact.
  Vec3 on_shape(const Vec3& point) const;

 private:
  struct Gap {
    Convex::Nearest core;
    Vec3 way;         ///< from the core's nearest point
    double distance;  ///< from the shape; negative inside of a rounded one
  };
  Gap gap(const Vec3& point) const;
  /// True if the point, line or plane that holds the shape's core is farther from the cell than its radius: where a
  /// capsule lies in a groove no plane separates the two, unless the cell is as small as the gap.
  bool is_beside(const SurfaceCell& cell, const FramedSample& nearest, double margin) const;
  bool is_apart_along_sides(const SurfaceCell& cell, double margin) const;
  /// Steps inside of the cell: towards where the surface meets the core, and towards where it is nearest to the core.
  std::optional<Parameter> step_across(const SurfaceCell& cell, const FramedSample& from, const Gap& gap) const;
  Parameter step_near(const SurfaceCell& cell, const FramedSample& from, const Gap& gap) const;
  bool approach(const SurfaceCell& cell, FramedSample& place, Gap& now) const;

  const Convex& shape_;
  const CellFrame& frame_;
  RayCounters& counters_;
};

}  // namespace shaolin
