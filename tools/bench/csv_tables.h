#pragma once
/// Measurements as CSV files.
#include <filesystem>
#include <string>
#include <vector>

#include "tools/bench/measure.h"

namespace shaolin {

/// Measurements of one scene, by name.
struct NamedMeasurements {
  std::string scene;
  const std::vector<Measurement>* measurements;
};

/// scene,method,parameter,mean_level,primary_0..primary_15,shadow_0..shadow_15
void write_level_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes);

/// scene,method,parameter,runs,tessellation,tessellation_least,tessellation_most,build,...,bytes,peak_bytes,estimated,
/// occluded_differs: seconds by phase, medians of runs; empty where nothing was timed.
void write_time_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes);

/// scene,method,parameter,of,rays,hits,lost,ghosts,distance_median,..._p99,..._max,normal_...,farther,nearer,
/// lost_outside,ghosts_outside: lengths of the scene's, angles in rad; the last four are empty but for chord and a3. A
/// measurement has a row of "picture" (primary and shadow rays), one of "random", and one of "ambient" rays, which tell
/// whether they hit alone; none of what was not traced.
void write_error_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes);

}  // namespace shaolin
