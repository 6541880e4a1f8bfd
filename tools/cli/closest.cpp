#include "tools/cli/closest.h"

#include <memory>

#include "tools/cli/number_checks.h"
#include "tools/cli/row_query.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

void closest_in_arena(const ClosestOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable points = options.points.read();
  const Scene scene = build_scene(stage, options.scene);
  answer_rows(
      points, options.output, "point", std::string("found,distance,") + place_columns, stage.is_scene,
      [&](const auto& row) { return scene.closest_point(vector_at(row, 0), options.radius); },
      [](CsvWriter& writer, const ClosestPoint& closest) {
        writer.field(closest.distance);
        write_place(writer, closest.at, closest.sample);
      });
  report_budget(scene, options.scene);
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
  options->points.add_options(*sub);
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
  add_budget_option(*sub, options->scene);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    expect_rows({&options->points}, options->output, inputs_of(options->model));
    command = [options] { return closest(*options); };
  });
}

}  // namespace shaolin
