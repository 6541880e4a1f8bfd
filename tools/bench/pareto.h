#pragma once
/// `shaolin bench pareto`: time against error, all methods in one plot.
#include <filesystem>
#include <optional>

#include "tools/bench/measure.h"

namespace shaolin {

struct ParetoOptions {
  ModelOptions model;
  std::filesystem::path report;    ///< --report: a folder
  ImageSize size;                  ///< --size
  std::optional<double> unit;      ///< --unit: the length that an epsilon of 1 stands for; see unit_of()
  double min_size = 2;             ///< --min-size
  std::optional<double> max_size;  ///< --max-size; a scene of the paper's: its own; else 12
  int most_level = 6;              ///< --level: of uniform triangles
  std::size_t exact_hits = 200;    ///< --exact-hits: held against refinement in quadruple precision
  MeasureOptions measure;          ///< --runs, --memory
  int threads = 0;                 ///< --threads: of what is not timed
};

/// What epsilon is measured by where nobody says: a scene of the paper's has its own unit (paper_figures.h); of any
/// other it is a fiftieth of the diagonal of its box, which is Frogship's.
double unit_of(const ModelOptions& model, double diagonal);
double max_size_of(const ModelOptions& model);

/// Measures, prints a line per method and the table, writes pareto.html, times.csv, errors.csv and exact.csv. Returns
/// exit_check_failed if a method's answers are no picture of the scene. Throws InputError, std::exception.
int bench_pareto(const ParetoOptions& options);

}  // namespace shaolin
