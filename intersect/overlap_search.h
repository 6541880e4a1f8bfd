#pragma once
/// A place of a surface that a shape holds, if there is one.
#include "cell_search.h"
#include "shape_probe.h"

namespace shaolin {

/// The goal of a search (cell_search.h) that ends at the first place that is found.
class OverlapSearch {
 public:
  struct Found {
    const SurfaceCell* cell;
    FramedSample place;
  };

  OverlapSearch(const Convex& shape, const CellFrame& frame, RayCounters& counters)
      : probe_(shape, frame, counters), error_(frame.error()) {}

  std::optional<double> look(const SurfaceCell& cell) {
    const ShapeProbe::Answer answer = probe_(cell, error_);
    if (answer.verdict == ShapeProbe::Verdict::apart) return {};
    if (answer.verdict == ShapeProbe::Verdict::met) found_ = Found{&cell, *answer.place};
    return answer.distance;
  }
  bool may_matter(const SurfaceCell&) const { return true; }
  bool is_done() const { return found_.has_value(); }

  const std::optional<Found>& found() const { return found_; }
  const ShapeProbe& probe() const { return probe_; }

 private:
  ShapeProbe probe_;
  double error_;
  std::optional<Found> found_;
};

}  // namespace shaolin
