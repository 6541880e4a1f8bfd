#include "tools/cli/pick.h"

#include <memory>

#include "tools/cli/framing.h"
#include "tools/cli/parse_into.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

Frustum of_rectangle(const View& view, std::span<const double> row) {
  const double left = row[0], top = row[1], right = row[2], bottom = row[3];
  if (!(0 <= left && left < right && right <= view.size().width && 0 <= top && top < bottom &&
        bottom <= view.size().height))
    throw InputError("a rectangle has 0 <= left < right <= " + std::to_string(view.size().width) +
                     " and 0 <= top < bottom <= " + std::to_string(view.size().height));
  return Frustum::of_view(view.camera().eye, {view.direction(left, top), view.direction(right, top),
                                              view.direction(right, bottom), view.direction(left, bottom)});
}

void write(CsvWriter& writer, std::size_t number, const std::vector<PickedFace>& picked, bool instances) {
  for (const PickedFace& one : picked) {
    writer.field(static_cast<long long>(number)).field(one.face);
    if (instances) writer.field(one.instance);
    writer.end_row();
  }
}

Frustum region_of(const CsvTable& sides) {
  Frustum region;
  for (std::size_t row = 0; row < sides.row_count(); ++row) {
    const std::span<const double> numbers = sides.row(row);
    const Vec3 normal = vector_at(numbers, 0);
    if (!normal.allFinite() || normal.isZero(0) || !std::isfinite(numbers[3]))
      sides.fail(row, "a side has a normal of any length but zero and an offset, all finite");
    region.sides.push_back({normal, numbers[3]});
  }
  return region;
}

void pick_in_arena(const PickOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable rows = options.sides.is_given() ? options.sides.read() : options.rectangles.read();
  const Scene scene = build_scene(stage, options.scene);
  CsvWriter writer(options.output, std::string("pick,face") + (stage.is_scene ? ",instance" : ""));
  if (options.sides.is_given()) {
    write(writer, 0, scene.pick(region_of(rows)), stage.is_scene);
  } else {
    const View view(options.camera ? *options.camera : choose_camera(stage, scene, options.size), options.size);
    process_rows(
        rows, [&](std::size_t row) { return scene.pick(of_rectangle(view, rows.row(row))); },
        [&](std::size_t row, const auto& picked) { write(writer, row, picked, stage.is_scene); });
  }
  writer.commit();
  report_budget(scene, options.scene);
}

}  // namespace

int pick(const PickOptions& options) {
  run_with_threads(options.threads, [&options] { pick_in_arena(options); });
  return exit_done;
}

void add_pick(CLI::App& app, Command& command) {
  const auto options = std::make_shared<PickOptions>();
  CLI::App* sub = app.add_subcommand("pick", "List the faces in rectangles of a picture, or in a convex region");
  add_stage_options(*sub, options->model);
  options->rectangles.add_options(*sub);
  sub->add_option_function<std::string>("--size", parse_into(options->size, parse_size, "--size"),
                                        "Size of the picture in pixels")
      ->type_name("WxH");
  sub->add_option_function<std::string>("--camera", parse_into(options->camera, parse_camera, "--camera"),
                                        "Eye, target, vertical angle in degrees, and what is up, as of render; by "
                                        "default the picture frames all")
      ->type_name("EX,EY,EZ,TX,TY,TZ,FOV[,UX,UY,UZ]");
  options->sides.add_options(*sub);
  sub->add_option("-o,--output", options->output,
                  "CSV file with one row per face of which a point is in the region, hidden or not: pick,face; pick is "
                  "the rectangle's number, or 0. Of scenes with one more column, instance")
      ->required()
      ->type_name("FILE");
  add_budget_option(*sub, options->scene);
  add_threads_option(*sub, options->threads);
  sub->callback([options, sub, &command] {
    expect_rows({&options->rectangles, &options->sides}, options->output, inputs_of(options->model));
    if (options->sides.is_given() && sub->count("--size") + sub->count("--camera") > 0)
      throw CLI::ValidationError("--size and --camera are for rectangles");
    command = [options] { return pick(*options); };
  });
}

}  // namespace shaolin
