#pragma once
/// Throws the rays: all families at all of their models, in rounds, on all threads.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/stress/family.h"
#include "tools/stress/peers.h"

namespace shaolin::stress {

struct RunOptions {
  std::vector<StressModel> models = {};    ///< for the families without models of their own
  std::vector<std::string> families = {};  ///< names; empty: all
  std::uint64_t seed = 1;
  std::size_t rays = 256;  ///< of each family at each of its models
  double minutes = 0;      ///< above 0: as many rays as there is time for, in place of `rays`
  QueriesOf queries_of = RayQueries::of;
  Peers* peers = nullptr;  ///< asked the same rays, if there are any
};

/// One family at one model.
struct Row {
  std::string family, model;
  Tally tally;
  double seconds = 0;
};

struct Result {
  std::vector<Row> rows;  ///< in the order of families(), then of models; without those that have nothing to aim at
  std::size_t rays = 0;   ///< of each family at each model: with it and the seed every number but `seconds` comes again
  double slowdown = 0;    ///< see bad_number_slowdown(); not measured: 0
  double seconds = 0;

  static constexpr double most_slowdown = 2;
  std::vector<Row> by_family() const;  ///< sums; `model` is empty
  Tally total() const;
  bool passed() const { return total().passed() && slowdown <= most_slowdown; }
};

/// Answers are the same for the same models, families, seed and rays, whatever the number of threads; a run of fewer
/// rays throws the first of them. Throws InputError for models that Scene refuses. `progress` is told after each round
/// the rays so far of each family at each model.
Result run(const RunOptions& options, const std::function<void(std::size_t)>& progress = {});

}  // namespace shaolin::stress
