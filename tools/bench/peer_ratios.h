#pragma once
/// What the exact method costs beside Embree: below 1 it is the faster, or the smaller, one.
#include <array>
#include <optional>
#include <vector>

#include "tools/bench/pareto.h"
#include "tools/bench/text_table.h"

namespace shaolin {

/// What times are compared of: those of phases, and the cold time where Embree's triangles are there already.
inline constexpr std::array ratio_names{"cold", "cold given triangles", "camera", "random", "shadow", "ambient"};

struct PeerRatios {
  Contender peer;
  std::array<std::optional<Spread>, ratio_names.size()> times;  ///< run by run; empty where there is nothing to compare
  double memory = 0;                                            ///< bytes after all rays
};

/// Beside all that Embree was timed with.
std::vector<PeerRatios> ratios_over_peers(const ParetoResult& result);

/// Those of one scene.
TextTable ratio_table(const ParetoResult& result);

/// Of all scenes beside levels 3 and 5, if these were timed, of Embree's subdivision, or of its triangles where
/// subdivision was not timed; with the exact method's greatest error along the ray, in diagonals.
TextTable bar_table(const std::vector<ParetoResult>& results);

/// What stands in it, in words.
extern const char* const bar_note;

}  // namespace shaolin
