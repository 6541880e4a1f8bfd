#pragma once
/// `shaolin bench paper`: Tables 1 to 4 and Figures 14 and 15 of Mueller et al. 2003, measured anew.
#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/measure.h"
#include "tools/bench/paper_figures.h"

namespace shaolin {

struct PaperOptions {
  std::filesystem::path scenes = "data/scenes";  ///< --scenes
  std::filesystem::path report;                  ///< --report: a folder
  std::vector<std::string> only;                 ///< --only: files of PaperScene; empty: all
  bool quads = false;                            ///< --catmark: the scenes' versions for Catmull-Clark
  ImageSize size;                                ///< --size
  int most_level = 7;                            ///< --level: of uniform triangles
  MeasureOptions measure;                        ///< --runs, --memory
  int threads = 0;                               ///< --threads: of what is not timed
};

/// Memory with and without instances that share.
struct MemoryFigures {
  struct Uniform {
    std::size_t bytes;
    bool estimated;
  };
  std::size_t shaolin = 0, a3 = 0;  ///< at epsilon 0.01
  std::vector<Uniform> uniform{};   ///< of levels 3 and up
};

/// How alike two level maps are.
struct MapLikeness {
  std::size_t both = 0, equal = 0, within_one = 0;  ///< pixels that both methods hit; of these, by levels
  std::size_t one_only = 0;                         ///< pixels that one of them hits
  double mean_difference = 0;                       ///< of ShaoLin's level from A3's
};

/// All about one scene.
struct PaperResult {
  const PaperScene* scene;
  std::vector<Measurement> measurements{};
  MemoryFigures shared{}, alone{};
  MapLikeness maps{};
  std::size_t primary = 0, shadow = 0;  ///< rays
  double diagonal = 0;

  /// Null if there is none.
  const Measurement* find(ContenderKind kind, double parameter) const;
};

/// The epsilon at which the paper tells memory, and we draw maps.
inline constexpr double paper_epsilon = 0.01;

/// Measures, prints a line per method, writes paper.html, levels.csv, times.csv, errors.csv, memory.csv and the maps as
/// PNG. Returns exit_check_failed if a method's answers are no picture of a scene. Throws InputError, std::exception.
int bench_paper(const PaperOptions& options);

/// The page; maps are named as bench_paper() names them.
void write_paper_page(std::ostream& out, const std::vector<PaperResult>& results, const PaperOptions& options);

/// The name of a scene's picture in the report: "shaolin", "a3" (maps) or "picture".
std::string picture_name(const PaperScene& scene, const std::string& what);

}  // namespace shaolin
