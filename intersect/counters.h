#pragma once
/// Work counters of one ray, and their sums.
#include <cstdint>

#include "ray.h"

namespace shaolin {

/// What one query did; added to the scene's totals when the query ends.
struct RayCounters {
  std::uint64_t hull_tests = 0;
  std::uint64_t cells = 0;
  std::uint64_t newton_steps = 0;

  void add_to(Statistics& total) const {
    total.hull_tests += hull_tests;
    total.cells += cells;
    total.newton_steps += newton_steps;
  }
};

}  // namespace shaolin
