#pragma once
/// The faces of a surface of which a convex polytope holds a point.
#include <set>

#include "cell_search.h"
#include "shape_probe.h"

namespace shaolin {

/// The goal of a search (cell_search.h) that ends when each face is known to have such a point, or to have none. A cell
/// that is inside of all sides is not refined: its faces have.
class PickSearch {
 public:
  PickSearch(const Convex& shape, const CellFrame& frame, RayCounters& counters)
      : shape_(shape), frame_(frame), probe_(shape, frame, counters) {}

  std::optional<double> look(SurfaceCell& cell) {
    if (is_picked(cell)) return {};
    if (is_inside(cell)) {
      pick(cell);
      return {};
    }
    const ShapeProbe::Answer answer = probe_(cell, frame_.error());
    if (answer.verdict == ShapeProbe::Verdict::met) pick(cell);
    if (answer.verdict != ShapeProbe::Verdict::open) return {};
    return answer.distance;
  }
  bool may_matter(const SurfaceCell& cell) const { return !is_picked(cell); }
  bool is_done() const { return false; }

  const std::set<int>& faces() const { return faces_; }

 private:
  bool is_picked(const SurfaceCell& cell) const { return cell.place().face >= 0 && faces_.contains(cell.place().face); }
  bool is_inside(const SurfaceCell& cell) const {
    const std::vector<Vec3>& sides = shape_.sides();
    return std::all_of(sides.begin(), sides.end(),
                       [&](const Vec3& side) { return -frame_.low(cell, -side) <= shape_.support(side); });
  }
  void pick(SurfaceCell& cell) {
    if (cell.place().face >= 0)
      faces_.insert(cell.place().face);
    else
      for (const auto& part : cell.parts()) pick(*part);
  }

  const Convex& shape_;
  const CellFrame& frame_;
  ShapeProbe probe_;
  std::set<int> faces_;
};

}  // namespace shaolin
