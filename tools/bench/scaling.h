#pragma once
/// `shaolin bench scaling`: what a scene costs as its control mesh grows.
#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/measure.h"
#include "tools/cli/camera.h"

namespace shaolin {

struct ScalingOptions {
  std::vector<std::size_t> faces{1000, 10000, 100000, 1000000};  ///< --faces: of the control meshes, about
  std::size_t instanced = 100000000;                             ///< --instanced: faces of the last scene, about
  ImageSize size{400, 400};                                      ///< --size
  int runs = 3;                                                  ///< --runs
  std::filesystem::path report;                                  ///< --report: a folder
};

/// What one size costs; seconds, of each run.
struct ScalingResult {
  std::string scene;
  std::size_t faces = 0, instances = 1;  ///< control faces in all, and how often the mesh stands in the scene
  std::vector<double> read{};            ///< the OBJ file
  std::vector<double> build{};           ///< from the mesh in memory to a scene that has met no ray
  std::vector<double> bytes{};  ///< of the heap that this takes, mesh and all; 0 where the allocator does not tell
  /// By threads, 1 and 2: the first rays of a new scene, and the same once more.
  std::array<std::vector<double>, 2> cold{}, warm{};
  std::size_t rays = 0, hits = 0;
  std::size_t faces_touched = 0,
              bytes_refined = 0;  ///< after the rays; bytes that Statistics counts, less those before
  std::string fault{};            ///< why nothing was timed; or empty
};

/// Bumpy tori of quads, seen whole. Before a size is timed, one and two threads must answer alike bit for bit, and of
/// meshes up to 10^5 faces a sample of hits must lie on OpenSubdiv's limit surface to 1e-9 of the diagonal. Prints a
/// line per size, writes scaling.html and scaling.csv. Returns exit_check_failed if a check failed. Throws InputError,
/// std::exception.
int bench_scaling(const ScalingOptions& options);

/// The page.
void write_scaling_page(std::ostream& out, const std::vector<ScalingResult>& results, const ScalingOptions& options);

}  // namespace shaolin
