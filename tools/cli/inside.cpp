#include "tools/cli/inside.h"

#include <iostream>
#include <memory>

#include "tools/cli/row_query.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

void inside_in_arena(const InsideOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable points = options.points.read();
  const Scene scene = build_scene(stage, options.scene);
  CsvWriter writer(options.output, "point,inside,signed_distance");
  process_rows(
      points, [&](std::size_t row) { return scene.signed_distance(vector_at(points.row(row), 0)); },
      [&](std::size_t row, double distance) {
        writer.field(static_cast<long long>(row)).field(std::signbit(distance) ? 1 : 0).field(distance).end_row();
      });
  writer.commit();
  std::cerr << points.row_count() << " points, " << scene.statistics().uncertified
            << " of them by hits that are not certified\n";
  report_budget(scene, options.scene);
}

}  // namespace

int inside(const InsideOptions& options) {
  run_with_threads(options.threads, [&options] { inside_in_arena(options); });
  return exit_done;
}

void add_inside(CLI::App& app, Command& command) {
  const auto options = std::make_shared<InsideOptions>();
  CLI::App* sub = app.add_subcommand("inside", "Find which points are inside of closed limit surfaces");
  add_stage_options(*sub, options->model);
  options->points.add_options(*sub);
  sub->add_option("-o,--output", options->output,
                  "CSV file with one row per point, in order: point,inside,signed_distance; inside is 1 or 0, and the "
                  "distance from the closest point of any surface is negative inside. All surfaces must be closed")
      ->required()
      ->type_name("FILE");
  add_budget_option(*sub, options->scene);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    expect_rows({&options->points}, options->output, inputs_of(options->model));
    command = [options] { return inside(*options); };
  });
}

}  // namespace shaolin
