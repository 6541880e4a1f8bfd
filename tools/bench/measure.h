#pragma once
/// Levels, errors, times and memory of many contenders in one scene.
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tools/bench/error_figures.h"
#include "tools/bench/workload.h"

namespace shaolin {

/// Hits by the level of the patch that was met.
struct LevelCounts {
  static constexpr std::size_t levels = 16;  ///< the last holds all that are deeper
  std::array<std::uint64_t, levels> hits{};

  void add(int level);
  std::uint64_t total() const;
  double mean() const;  ///< 0 without hits
};

struct Measurement {
  Contender contender;
  LevelCounts primary{}, shadow{};
  ErrorFigures errors{};             ///< of primary and shadow rays together
  std::size_t occluded_differs = 0;  ///< shadow rays that occluded() answers otherwise than intersect() does
  std::string fault{};               ///< why its answers are no picture of the scene, so that it is not timed; or empty
  std::vector<double> seconds{};     ///< of each run, from meshes in memory to the last answer, cold, on one thread
  std::vector<double> again{};       ///< of each run: the same rays once more, with all that the first time made
  std::size_t bytes = 0;             ///< after all rays
  bool estimated = false;            ///< not run: bytes are four times those of the level before

  LevelCounts levels() const;  ///< of both kinds of rays
};

/// Median, least and most.
struct Spread {
  double median = 0, least = 0, most = 0;
};
Spread spread(std::vector<double> values);

/// By how much `a` takes longer than `b`, run by run, as both were run in turns.
Spread ratio(const Measurement& a, const Measurement& b);

/// A scene and what it is asked.
struct Subject {
  Stage stage;
  Scene exact;
  View view;
  Workload work;
  Answers primary, shadow;  ///< the exact ones
  double diagonal;          ///< of the scene's box

  Subject(const ModelOptions& model, ImageSize size);
};

struct MeasureOptions {
  int runs = 3;
  std::size_t most_bytes = std::size_t{1} << 30;  ///< what uniform triangles may occupy; what is beyond is estimated
};

/// First the answers of all contenders, in parallel, each held against the exact ones; then their times, run by run,
/// contenders in turns, so that a busy moment of the machine meets all. Uniform levels must come in ascending order.
/// Throws what the parts throw.
std::vector<Measurement> measure(const Subject& subject, std::span<const Contender> contenders,
                                 const MeasureOptions& options);

/// The bytes after all rays of the work, with this stage in place of the subject's.
std::size_t bytes_after(const Contender& contender, const Subject& subject, const Stage& stage);

/// The same stage with a mesh of its own for each instance, as a renderer without instances would hold it.
Stage without_sharing(const Stage& stage);

}  // namespace shaolin
