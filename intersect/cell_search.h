#pragma once
/// Branch and bound over the cells of a surface.
#include "counters.h"
#include "nearest_queue.h"
#include "surface_cell.h"

namespace shaolin {

/// Looks at cells, the most promising first, and at the parts of those that may matter. A Goal has
///
///     std::optional<double> look(SurfaceCell&);  // empty: nothing of the cell matters; else where it stands in the
///     line bool may_matter(const SurfaceCell&);       // when its turn has come: what was found since may have settled
///     it bool is_done() const;
///
/// The order depends on the cells and the goal alone.
template <class Goal>
void search_cells(SurfaceCell& root, Goal& goal, RayCounters& counters) {
  NearestQueue<SurfaceCell*> queue;
  const auto look = [&](SurfaceCell& cell) {
    ++counters.cells;
    if (const std::optional<double> rank = goal.look(cell)) queue.push(static_cast<float>(*rank), &cell);
  };
  look(root);
  while (!queue.empty() && !goal.is_done()) {
    SurfaceCell& cell = *queue.pop();
    if (!goal.may_matter(cell)) continue;
    for (const auto& part : cell.parts()) {
      if (goal.is_done()) return;
      look(*part);
    }
  }
}

}  // namespace shaolin
