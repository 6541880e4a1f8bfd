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

/// What is timed, each by itself: processor time of one thread.
enum class Phase {
  tessellation,  ///< of Embree's triangles alone: making them, which is this library's work
  build,         ///< from meshes (of Embree's triangles: from these) in memory to a scene, without what waits for rays
  cold,          ///< tessellation, build and the first image: primary and shadow rays
  camera,        ///< primary rays; these and the others are warm: all rays were traced before
  shadow,        ///< by occluded()
  random,        ///< by intersect()
  ambient,       ///< by occluded()
};
inline constexpr std::array phases{Phase::tessellation, Phase::build,  Phase::cold,   Phase::camera,
                                   Phase::shadow,       Phase::random, Phase::ambient};
const char* name_of(Phase phase);

/// Median, least and most.
struct Spread {
  double median = 0, least = 0, most = 0;
};
Spread spread(std::vector<double> values);

struct Measurement {
  Contender contender;
  LevelCounts primary{}, shadow{};
  ErrorFigures errors{};  ///< of primary and shadow rays together
  ErrorFigures random_errors{};
  HitFigures ambient_errors{};       ///< occluded() tells no distance
  std::size_t occluded_differs = 0;  ///< shadow rays that occluded() answers otherwise than intersect() does
  std::string fault{};               ///< why its answers are no picture of the scene, so that it is not timed; or empty
  /// By phase, of each run; empty where there is nothing to time.
  std::array<std::vector<double>, phases.size()> seconds{};
  std::size_t bytes = 0;       ///< after all rays
  std::size_t peak_bytes = 0;  ///< most by which a timed run raised the process's resident memory; 0: not timed
  bool estimated = false;      ///< not run: bytes are four times those of the level before

  LevelCounts levels() const;  ///< of primary and shadow rays
  const std::vector<double>& times(Phase phase) const { return seconds[static_cast<std::size_t>(phase)]; }
  bool is_timed(Phase phase = Phase::cold) const { return !times(phase).empty(); }
};

/// By how much `a` takes longer than `b` in a phase, run by run, as both were run in turns.
Spread ratio(const Measurement& a, const Measurement& b, Phase phase = Phase::cold);

enum class WarmRays { of_picture, random_and_ambient_too };

/// A scene and what it is asked.
struct Subject {
  Stage stage;
  Scene exact;
  View view;
  Workload work;
  Answers primary, shadow, random;  ///< the exact ones
  Occlusions ambient;               ///< the exact ones, too
  double diagonal;                  ///< of the scene's box

  Subject(Stage stage, ImageSize size, WarmRays warm = WarmRays::of_picture);
};

struct MeasureOptions {
  int runs = 3;
  /// What a level of triangles may occupy (beyond, it is estimated), and contenders together that take turns.
  std::size_t most_bytes = std::size_t{1} << 30;
};

/// First the answers of all contenders, in parallel, each held against the exact ones; then their times, run by run, by
/// time_run(), as many neighbours at a time as may occupy memory. Uniform levels must come in ascending order.
/// Throws what the parts throw.
std::vector<Measurement> measure(const Subject& subject, std::span<const Contender> contenders,
                                 const MeasureOptions& options);

/// The bytes after all rays of the work, with this stage in place of the subject's.
std::size_t bytes_after(const Contender& contender, const Subject& subject, const Stage& stage);

/// The same stage with a mesh of its own for each instance, as a renderer without instances would hold it.
Stage without_sharing(const Stage& stage);

}  // namespace shaolin
