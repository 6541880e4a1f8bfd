#pragma once
/// Where a moving sphere first meets a surface.
#include "cell_search.h"
#include "shape_probe.h"

namespace shaolin {

/// The goal of a search (cell_search.h). What a sphere passes through until the time t is a capsule, which shrinks each
/// time that an earlier contact is found: so a cell is done when a plane proves that the capsule has none of it but
/// what is rounding. On cells that it meets, Newton's steps look for the place of the cell with the earliest contact.
class SweepSearch {
 public:
  struct Found {
    const SurfaceCell* cell;
    CellSample place;
    double t;
  };

  /// The sphere is free at t = 0 and goes by a displacement that is not zero; all in the query's frame. `earliest` is
  /// the time of the earliest contact known, if there is one: only what is before it is looked for.
  SweepSearch(const SphereSweep& sweep, std::optional<double> earliest, const CellFrame& frame, RayCounters& counters);

  std::optional<double> look(const SurfaceCell& cell);
  bool may_matter(const SurfaceCell& cell) const { return !probe_.is_apart(cell, toward_, margin()); }
  bool is_done() const { return earliest_ && *earliest_ <= 0; }

  const std::optional<Found>& found() const { return found_; }

 private:
  /// A place once the sphere touches it, and what leads to an earlier one.
  struct Moment {
    FramedSample place;
    double t;
  };

  /// Against an earlier contact, rounding makes no difference that is one.
  double margin() const { return earliest_ ? -frame_.error() : frame_.error(); }
  /// When the sphere first touches a point; empty if that is after what is known, or never.
  std::optional<double> time_of(const Vec3& point) const;
  void improve(const SurfaceCell& cell, const FramedSample& from);
  void polish(const SurfaceCell& cell, Moment& moment) const;
  Parameter step(const SurfaceCell& cell, const Moment& from) const;
  void take(const SurfaceCell& cell, const Moment& moment);

  SphereSweep sweep_;
  const CellFrame& frame_;
  RayCounters& counters_;
  std::optional<double> earliest_;
  Simplex swept_;
  ShapeProbe probe_;            ///< of swept_
  Vec3 toward_ = Vec3::Zero();  ///< from the sphere's centre to the earliest contact
  std::optional<Found> found_;
};

}  // namespace shaolin
