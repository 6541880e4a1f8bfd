#pragma once
/// `shaolin bench closest`: closest points against brute force, and against CGAL's tree over triangles.
#include <cstdint>
#include <filesystem>
#include <vector>

namespace shaolin {

struct ClosestBenchOptions {
  std::vector<std::filesystem::path> models;  ///< MODEL..., meshes of Loop or Catmull-Clark
  std::size_t checked = 1000;                 ///< --checked: points of each model that brute force looks at, too
  std::size_t queries = 20000;                ///< --queries: that are timed
  double error = 1e-6;                        ///< --error: that triangles may have, in diagonals
  std::size_t most_triangles = 4000000;       ///< --triangles: that they may be
  int runs = 5;                               ///< --runs
  std::uint64_t seed = 1;                     ///< --seed
  int threads = 0;                            ///< --threads: of brute force
};

/// Asks each model for the places closest to random points: a third near the surface, from 1e-8 to 1e-1 of the diagonal
/// off it, a third in its box, a third in one three times as large. Brute force (dense_sampling.h) finds points of the
/// surface, so what is farther than they are by more than 1e-12 of the diagonal is wrong; so is what evaluation does
/// not find at its parameters. Then triangles are refined until none of 2000 distances by CGAL's tree over them is off
/// by more than `error`, or the next level would be too many, and both are timed in turns on one thread, warm.
///
/// Prints a row per model, and what is wrong as points for `shaolin closest`. Returns exit_check_failed if anything is.
/// The same options give the same points. Throws InputError for models that are not of Loop or Catmull-Clark.
int bench_closest(const ClosestBenchOptions& options);

}  // namespace shaolin
