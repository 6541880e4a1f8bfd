#include "tools/bench/csv_tables.h"

#include "tools/bench/page_parts.h"
#include "tools/cli/csv.h"

namespace shaolin {
namespace {

void begin_row(CsvWriter& writer, const std::string& scene, const Contender& contender) {
  writer.field(scene).field(contender.method());
  if (contender.kind == ContenderKind::exact)
    writer.empty();
  else
    writer.field(digits(contender.parameter(), 6));
}

/// Calls write(writer, measurement) for each row, after its first three fields.
template <class Write>
void write_table(const std::filesystem::path& file, const std::string& columns,
                 const std::vector<NamedMeasurements>& scenes, Write write) {
  CsvWriter writer(file, "scene,method,parameter," + columns);
  for (const NamedMeasurements& scene : scenes)
    for (const Measurement& one : *scene.measurements) {
      begin_row(writer, scene.scene, one.contender);
      write(writer, one);
      writer.end_row();
    }
  writer.commit();
}

CsvWriter& count(CsvWriter& writer, std::uint64_t value) { return writer.field(static_cast<long long>(value)); }

}  // namespace

void write_level_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes) {
  std::string columns = "mean_level";
  for (const std::string kind : {"primary_", "shadow_"})
    for (std::size_t level = 0; level < LevelCounts::levels; ++level) columns += "," + kind + std::to_string(level);
  write_table(file, columns, scenes, [](CsvWriter& writer, const Measurement& one) {
    if (one.estimated) {
      writer.empty(1 + 2 * static_cast<int>(LevelCounts::levels));
      return;
    }
    writer.field(one.levels().mean());
    for (const LevelCounts* const counts : {&one.primary, &one.shadow})
      for (const std::uint64_t hits : counts->hits) count(writer, hits);
  });
}

void write_time_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes) {
  std::string columns = "runs";
  for (const Phase phase : phases)
    for (const std::string end : {"", "_least", "_most"}) columns += "," + (name_of(phase) + end);
  write_table(file, columns + ",bytes,peak_bytes,estimated,occluded_differs", scenes,
              [](CsvWriter& writer, const Measurement& one) {
                count(writer, one.times(Phase::cold).size());
                for (const Phase phase : phases) {
                  const Spread seconds = spread(one.times(phase));
                  if (one.is_timed(phase))
                    writer.field(seconds.median).field(seconds.least).field(seconds.most);
                  else
                    writer.empty(3);
                }
                count(writer, one.bytes);
                if (one.is_timed())
                  count(writer, one.peak_bytes);
                else
                  writer.empty();
                writer.field(one.estimated ? 1 : 0);
                count(writer, one.occluded_differs);
              });
}

void write_error_table(const std::filesystem::path& file, const std::vector<NamedMeasurements>& scenes) {
  CsvWriter writer(file,
                   "scene,method,parameter,of,rays,hits,lost,ghosts,distance_median,distance_p99,distance_max,"
                   "normal_median,normal_p99,normal_max,farther,nearer,lost_outside,ghosts_outside");
  const auto begin = [&](const NamedMeasurements& scene, const Contender& contender, const char* of,
                         const HitFigures& figures) {
    begin_row(writer, scene.scene, contender);
    writer.field(of);
    for (const std::size_t value : {figures.rays, figures.hits, figures.lost, figures.ghosts}) count(writer, value);
  };
  const auto write = [&](const NamedMeasurements& scene, const Contender& contender, const char* of,
                         const ErrorFigures& figures) {
    if (figures.rays == 0) return;
    begin(scene, contender, of, figures);
    for (const Quantiles* const quantiles : {&figures.distance, &figures.normal})
      writer.field(quantiles->median).field(quantiles->p99).field(quantiles->max);
    if (contender.is_adaptive())
      for (const std::size_t value : {figures.farther, figures.nearer, figures.lost_outside, figures.ghosts_outside})
        count(writer, value);
    else
      writer.empty(4);
    writer.end_row();
  };
  for (const NamedMeasurements& scene : scenes)
    for (const Measurement& one : *scene.measurements) {
      write(scene, one.contender, "picture", one.errors);
      write(scene, one.contender, "random", one.random_errors);
      if (one.ambient_errors.rays == 0) continue;
      begin(scene, one.contender, "ambient", one.ambient_errors);
      writer.empty(10);
      writer.end_row();
    }
  writer.commit();
}

}  // namespace shaolin
