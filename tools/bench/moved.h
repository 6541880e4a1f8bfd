#pragma once
/// `shaolin bench moved`: errors where a model is far from the origin, tiny or huge, ours and those of peers.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/cli/model.h"

namespace shaolin {

struct MovedOptions {
  std::vector<std::filesystem::path> models;                      ///< MODEL...
  ModelOptions scheme;                                            ///< --scheme, --plugin
  std::vector<double> shifts{0, 1e2, 1e4, 1e6, 1e8};              ///< --shifts: in diagonals
  std::vector<double> scales{1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12};  ///< --scales
  std::size_t rays = 10000;                                       ///< --rays: at each model that was moved
  std::size_t exact_hits = 100;                                   ///< --exact-hits
  int level = 5;                                                  ///< --level: of triangles and of subdivision
  std::uint64_t seed = 1;                                         ///< --seed
  int threads = 0;                                                ///< --threads
};

/// Moves the control points, and asks the exact method, Embree's triangles and its subdivision (robust), and CGAL's
/// tree over triangles for rays from around the model to points of its box, and through edges and vertices. Prints a
/// row for each: hits that it loses and makes up against the exact method, and by how much others are off along the
/// ray, in diagonals of the model. What triangles lose at outlines is their error, not that of their queries: the rows
/// of a model that is not moved show how much that is. Of the exact method errors are those of exact_errors(): from the
/// hit to the surface of the moved control points, refined in numbers of 113 bits. Schemes that the others do not have,
/// plug-ins' among them, have the exact method's rows alone.
///
/// Returns exit_done. The same options give the same rays. Throws InputError.
int bench_moved(const MovedOptions& options);

}  // namespace shaolin
