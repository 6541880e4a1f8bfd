#include "tools/cli/closest.h"

#include <memory>
#include <optional>
#include <string_view>

#include "tools/cli/csv_vector.h"
#include "tools/cli/distinct_files.h"
#include "tools/cli/number_checks.h"
#include "tools/cli/number_list.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/stage.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr std::string_view point_columns = "x,y,z";
constexpr std::string_view closest_columns = "point,found,distance,face,sub,u,v,px,py,pz,nx,ny,nz";
constexpr std::string_view scene_closest_columns = "point,found,distance,face,sub,u,v,px,py,pz,nx,ny,nz,instance";

CsvTable read_points(const ClosestOptions& options) {
  if (!options.file.empty()) {
    CsvTable table = read_csv(options.file, {3});
    check_header(table, options.file.string(), point_columns);
    return table;
  }
  CsvTable table("--point");
  int number = 0;
  for (const Vec3& p : options.points) table.add_row(std::array{p.x(), p.y(), p.z()}, ++number);
  return table;
}

void write(CsvWriter& writer, std::size_t point, const std::optional<ClosestPoint>& closest, bool instances) {
  writer.field(static_cast<long long>(point)).field(closest ? 1 : 0);
  if (closest) {
    writer.field(closest->distance).field(closest->at.face).field(closest->at.sub);
    writer.field(closest->at.u).field(closest->at.v);
    write_vector(writer, closest->sample.position);
    write_normal(writer, closest->sample.normal);
    if (instances) writer.field(closest->instance);
  } else {
    writer.empty(instances ? 12 : 11);
  }
  writer.end_row();
}

void closest_in_arena(const ClosestOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable points = read_points(options);
  const Scene scene = build_scene(stage);
  CsvWriter writer(options.output, stage.is_scene ? scene_closest_columns : closest_columns);
  process_rows(
      points,
      [&](std::size_t row) {
        const auto p = points.row(row);
        return scene.closest_point({p[0], p[1], p[2]}, options.radius);
      },
      [&](std::size_t row, const auto& closest) { write(writer, row, closest, stage.is_scene); });
  writer.commit();
}

Vec3 parse_point(const std::string& text) {
  const auto numbers = parse_list<3>(text);
  if (!numbers) throw CLI::ValidationError("--point", "'" + text + "' is not x,y,z: three finite numbers");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

}  // namespace

int closest(const ClosestOptions& options) {
  run_with_threads(options.threads, [&options] { closest_in_arena(options); });
  return exit_done;
}

void add_closest(CLI::App& app, Command& command) {
  const auto options = std::make_shared<ClosestOptions>();
  CLI::App* sub = app.add_subcommand("closest", "Find the points of the limit surface that are closest to given ones");
  add_stage_options(*sub, options->model);
  CLI::Option* const file =
      sub->add_option("--points", options->file, "CSV file with the columns x,y,z; a header is optional")
          ->type_name("FILE");
  CLI::Option* const point = sub->add_option_function<std::vector<std::string>>(
                                    "--point",
                                    [options](const std::vector<std::string>& texts) {
                                      for (const std::string& text : texts)
                                        options->points.push_back(parse_point(text));
                                    },
                                    "A point, instead of a file; may be given again")
                                 ->type_name("X,Y,Z")
                                 ->allow_extra_args(false)
                                 ->excludes(file);
  sub->add_option("--radius", options->radius, "Look no farther than this; by default anywhere")
      ->type_name("LENGTH")
      ->check(is_positive());
  sub->add_option(
         "-o,--output", options->output,
         "CSV file with one row per point, in order: point,found,distance,face,sub,u,v,px,py,pz,nx,ny,nz; with nothing "
         "within the radius, found is 0 and the fields after it are empty; the normal is empty where the surface has "
         "none. Of scenes with one more column, instance, which counts from 0 in the file's order with groups "
         "dissolved")
      ->required()
      ->type_name("FILE");
  add_threads_option(*sub, options->threads);
  sub->callback([options, file, point, &command] {
    if (file->count() + point->count() == 0) throw CLI::RequiredError("--points or --point");
    std::vector<NamedFile> inputs = inputs_of(options->model);
    if (file->count() > 0) inputs.push_back({"--points", options->file});
    expect_distinct_files({{"--output", options->output}}, inputs);
    command = [options] { return closest(*options); };
  });
}

}  // namespace shaolin
