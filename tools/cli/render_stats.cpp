#include "tools/cli/render_stats.h"

#include <sys/resource.h>

#include <fstream>
#include <stdexcept>

#include "intersect/instruction_set.h"
#include "tools/cli/json_text.h"

namespace shaolin {
namespace {

Json to_json(const Statistics& statistics) {
  return {{"rays", statistics.rays},
          {"hits", statistics.hits},
          {"faces", statistics.faces},
          {"faces_touched", statistics.faces_touched},
          {"faces_never_touched", statistics.faces - statistics.faces_touched},
          {"patches_split", statistics.patches_split},
          {"patches_evicted", statistics.patches_evicted},
          {"hull_tests", statistics.hull_tests},
          {"cells", statistics.cells},
          {"newton_steps", statistics.newton_steps},
          {"uncertified", statistics.uncertified},
          {"chord_tests", statistics.chord_tests},
          {"w_cases", statistics.w_cases},
          {"gap_polygons", statistics.gap_polygons},
          {"gap_polygons_hit", statistics.gap_polygons_hit},
          {"border_areas_hit", statistics.border_areas_hit},
          {"depth_bounds", statistics.depth_bounds},
          {"invalid_patches", statistics.invalid_patches},
          {"unresolved_patches", statistics.unresolved_patches},
          {"bytes", statistics.bytes}};
}

Json to_json(const RenderStats& stats) {
  Json json{{"model", stats.model},
            {"scheme", stats.scheme},
            {"camera", stats.camera},
            {"threads", stats.threads},
            {"instruction_set", name_of(instruction_set())},
            {"image", {{"width", stats.size.width}, {"height", stats.size.height}, {"pixels_hit", stats.pixels_hit}}},
            {"seconds",
             {{"load", stats.load_seconds},
              {"build", stats.build_seconds},
              {"render", stats.render_seconds},
              {"write", stats.write_seconds},
              {"total", stats.total_seconds()}}},
            {"peak_memory_bytes", peak_memory()},
            {"statistics", to_json(stats.statistics)}};
  if (stats.instances) json["instances"] = *stats.instances;
  return json;
}

}  // namespace

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

void write_stats(const std::filesystem::path& file, const RenderStats& stats) {
  std::ofstream stream(file);
  stream << to_json(stats).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot write the statistics");
}

}  // namespace shaolin
