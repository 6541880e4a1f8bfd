#pragma once
/// What a rendering cost.
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "intersect/ray.h"
#include "tools/cli/camera.h"

namespace shaolin {

/// Wall-clock seconds between laps.
class Stopwatch {
 public:
  /// Seconds since the last lap or the construction.
  double lap() {
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> elapsed = now - last_;
    last_ = now;
    return elapsed.count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

struct RenderStats {
  std::string model, scheme;
  std::string camera;                    ///< as --camera takes it
  std::optional<std::size_t> instances;  ///< of a scene file
  ImageSize size;
  int threads = 1;
  std::size_t pixels_hit = 0;
  double load_seconds = 0;    ///< reading the file
  double build_seconds = 0;   ///< building the scene
  double render_seconds = 0;  ///< from camera to image
  double write_seconds = 0;   ///< image files
  Statistics statistics;

  double total_seconds() const { return load_seconds + build_seconds + render_seconds + write_seconds; }
};

/// The most memory that this process has held so far, in bytes.
std::size_t peak_memory();

/// Writes a JSON object:
///
///     model, scheme, camera, threads, peak_memory_bytes, instances (of scene files)
///     image       { width, height, pixels_hit }
///     seconds     { load, build, render, write, total }
///     statistics  { every field of Statistics, faces_never_touched }
///
/// Throws std::runtime_error if the file cannot be written.
void write_stats(const std::filesystem::path& file, const RenderStats& stats);

}  // namespace shaolin
