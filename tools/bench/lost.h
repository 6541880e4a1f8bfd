#pragma once
/// `shaolin bench lost`: hits that chords lose or make up outside of the band that their tolerance implies.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/error_figures.h"
#include "tools/bench/pareto.h"

namespace shaolin {

struct LostOptions {
  std::vector<std::filesystem::path> models;  ///< MODEL..., scenes or meshes
  bool a3 = false;                            ///< --a3: in place of ShaoLin
  std::size_t rays = 100000;                  ///< --rays: of each model, and a tenth more that are aimed
  std::uint64_t seed = 1;                     ///< --seed
  double epsilon = 0.01;                      ///< --epsilon, in units
  std::optional<double> unit;                 ///< --unit, see unit_of()
  double min_size = 2;                        ///< --min-size
  std::optional<double> max_size;             ///< --max-size
  int threads = 0;                            ///< --threads
};

/// Throws rays at each model (see sample_rays(): cameras, incoherent, grazing, aimed at edges and vertices; all
/// instances have the same number), every second with the footprint of a pixel of an 800x800 camera, and counts what
/// chords answer otherwise than the exact method. Prints a row per model and the first rays outside of the band, as
/// rows for `shaolin query`. Returns exit_check_failed if there are any. The same options give the same rays.
int bench_lost(const LostOptions& options);

}  // namespace shaolin
