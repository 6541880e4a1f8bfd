#pragma once
/// What Mueller, Techmann and Fellner measured (Adaptive Ray Tracing of Subdivision Surfaces, Eurographics 2003,
/// section 9), as printed.
#include <array>
#include <optional>
#include <span>
#include <string>

namespace shaolin {

/// A row of Tables 1 to 3.
struct PaperLevels {
  double epsilon, mean;
  std::array<int, 7> hits;  ///< of levels 0 and 1 together, then of 2 to 7
};

/// A scene, and how it was measured.
struct PaperScene {
  const char* file;   ///< in data/scenes, without .json
  const char* title;  ///< as the paper writes it
  int faces;          ///< of all control meshes
  double max_size;    ///< pixels; min_size is 2 everywhere
  double unit;        ///< ours: the length that an epsilon of 1 stands for
  std::array<PaperLevels, 7> levels;
  int shaolin_mb;                                ///< Table 4, at epsilon 0.01
  std::array<std::optional<int>, 5> uniform_mb;  ///< of levels 3 to 7; empty: could not be run
};

/// Frogship, Col-Henge, Eggs'n'Bunnies: Tables 1, 2, 3.
///
/// The paper's epsilon is a length whose unit it does not tell. One unit for each scene is chosen such that the mean
/// level falls from epsilon 0.005 to 0.5 by as much as in its table, and written here; see docs/bench.md.
std::span<const PaperScene> paper_scenes();

}  // namespace shaolin
