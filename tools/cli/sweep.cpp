#include "tools/cli/sweep.h"

#include <memory>

#include "tools/cli/row_query.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

void sweep_in_arena(const SweepOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable sweeps = options.sweeps.read();
  const Scene scene = build_scene(stage, options.scene);
  answer_rows(
      sweeps, options.output, "sphere", std::string("hit,t,") + place_columns + ",cx,cy,cz", stage.is_scene,
      [&](const auto& row) {
        return scene.sweep(SphereSweep{vector_at(row, 0), row[6], vector_at(row, 3)});
      },
      [](CsvWriter& writer, const SweepContact& contact) {
        writer.field(contact.t);
        write_place(writer, contact.at, contact.sample);
        write_vector(writer, contact.centre);
      });
  report_budget(scene, options.scene);
}

}  // namespace

int sweep(const SweepOptions& options) {
  run_with_threads(options.threads, [&options] { sweep_in_arena(options); });
  return exit_done;
}

void add_sweep(CLI::App& app, Command& command) {
  const auto options = std::make_shared<SweepOptions>();
  CLI::App* sub = app.add_subcommand("sweep", "Find where moving spheres first touch the limit surface");
  add_stage_options(*sub, options->model);
  options->sweeps.add_options(*sub);
  sub->add_option("-o,--output", options->output,
                  "CSV file with one row per sphere, in order: sphere,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz,cx,cy,cz; t "
                  "is the share of its way after which it touches the point p of the surface, its centre being at c "
                  "then; 0 if it does from the start. Without contact hit is 0 and the fields after it are empty. " +
                      std::string(instance_column))
      ->required()
      ->type_name("FILE");
  add_budget_option(*sub, options->scene);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    expect_rows({&options->sweeps}, options->output, inputs_of(options->model));
    command = [options] { return sweep(*options); };
  });
}

}  // namespace shaolin
