#pragma once
/// `shaolin bench pareto`: time and memory against error, all methods in one plot.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/exact_errors.h"
#include "tools/bench/measure.h"

namespace shaolin {

struct ParetoOptions {
  std::vector<std::filesystem::path> files;  ///< SCENE...
  ModelOptions scheme;                       ///< --scheme, --plugin: for all of them; without a file
  std::filesystem::path report;              ///< --report: a folder
  ImageSize size;                            ///< --size
  std::optional<double> unit;                ///< --unit: the length that an epsilon of 1 stands for; see unit_of()
  double min_size = 2;                       ///< --min-size
  std::optional<double> max_size;            ///< --max-size; a scene of the paper's: its own; else 12
  std::vector<std::string> methods;          ///< --methods: name_of(ContenderKind); empty: all; exact always is
  int most_level = 6;                        ///< --level: of uniform triangles and Embree's
  std::size_t exact_hits = 200;              ///< --exact-hits: held against refinement in quadruple precision
  MeasureOptions measure;                    ///< --runs, --memory
  int threads = 0;                           ///< --threads: of what is not timed
};

/// All about one scene.
struct ParetoResult {
  std::string scene;                                             ///< its file's name, without folder and extension
  double unit = 0;                                               ///< of epsilon
  double max_size = 0;                                           ///< pixels
  double diagonal = 0;                                           ///< of its box
  std::string left_out{};                                        ///< why Embree's subdivision is; or empty
  std::size_t primary = 0, shadow = 0, random = 0, ambient = 0;  ///< rays
  std::vector<Measurement> measurements{};
  ExactErrors exact{};
};

/// What epsilon is measured by where nobody says: a scene of the paper's has its own unit (paper_figures.h); of any
/// other it is a fiftieth of the diagonal of its box, which is Frogship's.
double unit_of(const ModelOptions& model, double diagonal);
double max_size_of(const ModelOptions& model);

/// Measures, prints a line per method and last bar_table() (peer_ratios.h), writes pareto.html, pareto.json, times.csv,
/// errors.csv and exact.csv. Returns exit_check_failed if a method's answers are no picture of a scene. Throws
/// InputError, before it measures anything if a file cannot be read; std::exception.
int bench_pareto(const ParetoOptions& options);

/// The page, and everything as JSON.
void write_pareto_page(std::ostream& out, const std::vector<ParetoResult>& results, const ParetoOptions& options);
void write_pareto_json(std::ostream& out, const std::vector<ParetoResult>& results, const ParetoOptions& options);

}  // namespace shaolin
