#include "tools/cli/overlap.h"

#include <memory>
#include <numbers>

#include "tools/cli/row_query.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

Shape sphere(std::span<const double> row) { return Sphere{vector_at(row, 0), row[3]}; }

Shape box(std::span<const double> row) {
  OrientedBox box{vector_at(row, 0), vector_at(row, 3)};
  if (row.size() < 10) return box;
  const Vec3 axis = vector_at(row, 6);
  if (axis.isZero(0)) throw InputError("the axis of the turn is zero; expected a direction of any other length");
  box.axes = Eigen::AngleAxisd(row[9] * std::numbers::pi / 180, axis.stableNormalized()).toRotationMatrix();
  return box;
}

Shape capsule(std::span<const double> row) { return Capsule{vector_at(row, 0), vector_at(row, 3), row[6]}; }

Shape triangle(std::span<const double> row) {
  return Triangle{vector_at(row, 0), vector_at(row, 3), vector_at(row, 6)};
}

using ShapeOf = Shape (*)(std::span<const double>);

/// The kind of shape that is given, and what a row of its numbers is.
std::pair<const RowInput&, ShapeOf> given(const OverlapOptions& options) {
  if (options.spheres.is_given()) return {options.spheres, sphere};
  if (options.boxes.is_given()) return {options.boxes, box};
  if (options.capsules.is_given()) return {options.capsules, capsule};
  return {options.triangles, triangle};
}

void overlap_in_arena(const OverlapOptions& options) {
  Stage stage = load_stage(options.model);
  const auto& [input, shape_of] = given(options);
  const CsvTable shapes = input.read();
  const Scene scene = build_scene(stage, options.scene);
  answer_rows(
      shapes, options.output, "shape", std::string("overlaps,") + place_columns + ",sx,sy,sz", stage.is_scene,
      [&scene, to_shape = shape_of](const auto& row) { return scene.overlaps(to_shape(row)); },
      [](CsvWriter& writer, const ShapeContact& contact) {
        write_place(writer, contact.at, contact.sample);
        write_vector(writer, contact.on_shape);
      });
  report_budget(scene, options.scene);
}

}  // namespace

int overlap(const OverlapOptions& options) {
  run_with_threads(options.threads, [&options] { overlap_in_arena(options); });
  return exit_done;
}

void add_overlap(CLI::App& app, Command& command) {
  const auto options = std::make_shared<OverlapOptions>();
  CLI::App* sub = app.add_subcommand("overlap", "Find which shapes have a point in common with the limit surface");
  add_stage_options(*sub, options->model);
  for (RowInput* input : {&options->spheres, &options->boxes, &options->capsules, &options->triangles})
    input->add_options(*sub);
  sub->add_option("-o,--output", options->output,
                  "CSV file with one row per shape, in order: shape,overlaps,face,sub,u,v,px,py,pz,nx,ny,nz,sx,sy,sz; "
                  "overlaps is 1, with a point p of the surface and the same of the shape, s, or 0, and the fields "
                  "after it are empty. " +
                      std::string(instance_column))
      ->required()
      ->type_name("FILE");
  add_budget_option(*sub, options->scene);
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    expect_rows({&options->spheres, &options->boxes, &options->capsules, &options->triangles}, options->output,
                inputs_of(options->model));
    command = [options] { return overlap(*options); };
  });
}

}  // namespace shaolin
