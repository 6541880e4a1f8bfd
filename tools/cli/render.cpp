#include "tools/cli/render.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "schemes/errors.h"
#include "tools/cli/distinct_files.h"
#include "tools/cli/exr.h"
#include "tools/cli/framing.h"
#include "tools/cli/image.h"
#include "tools/cli/level_map.h"
#include "tools/cli/output_file.h"
#include "tools/cli/parse_into.h"
#include "tools/cli/png.h"
#include "tools/cli/render_image.h"
#include "tools/cli/render_stats.h"
#include "tools/cli/stage.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

/// The files of one run: each is written under a temporary name, and all get their own names at the end. They are
/// opened before the work starts, so that a folder that does not exist is not found out after it.
class OutputFiles {
 public:
  explicit OutputFiles(const RenderOptions& options)
      : exr(options.exr), png(open(options.png)), level_png(open(options.level_png)), stats(open(options.stats)) {}

  void commit() {
    exr.commit();
    for (const auto& file : {&png, &level_png, &stats})
      if (*file) (*file)->commit();
  }

  OutputFile exr;
  std::unique_ptr<OutputFile> png, level_png, stats;  ///< null: not asked for

 private:
  static std::unique_ptr<OutputFile> open(const std::filesystem::path& target) {
    return target.empty() ? nullptr : std::make_unique<OutputFile>(target);
  }
};

void print_summary(const RenderOptions& options, const RenderStats& stats) {
  for (const auto& file : {options.exr, options.png, options.level_png, options.stats})
    if (!file.empty()) std::printf("wrote %s\n", file.c_str());
  std::printf("%dx%d pixels, %zu on the surface; %.3f s in all: load %.3f, build %.3f, render %.3f, write %.3f\n",
              stats.size.width, stats.size.height, stats.pixels_hit, stats.total_seconds(), stats.load_seconds,
              stats.build_seconds, stats.render_seconds, stats.write_seconds);
  const Statistics& counts = stats.statistics;
  std::printf("%llu rays, %llu with a hit, %llu hits not certified\n", static_cast<unsigned long long>(counts.rays),
              static_cast<unsigned long long>(counts.hits), static_cast<unsigned long long>(counts.uncertified));
}

void render_in_arena(const RenderOptions& options) {
  RenderStats stats;
  stats.threads = thread_count(options.threads);
  stats.size = options.size;
  Stopwatch stopwatch;

  Stage stage = load_stage(options.model);
  stats.model = options.model.file.string();
  stats.scheme = stage.schemes();
  if (stage.is_scene) stats.instances = stage.scene.instances.size();
  stats.load_seconds = stopwatch.lap();

  const Scene scene = build_scene(stage, options.scene);
  stats.build_seconds = stopwatch.lap();

  OutputFiles files(options);
  const View view(options.camera ? *options.camera : choose_camera(stage, scene, options.size), options.size);
  const Image image = render_image(scene, view, stage.scene.look, options.scene);
  stats.render_seconds = stopwatch.lap();
  stats.camera = to_string(view.camera());
  stats.statistics = scene.statistics();
  stats.pixels_hit = static_cast<std::size_t>(
      std::count_if(image.pixels.begin(), image.pixels.end(), [](const Pixel& pixel) { return pixel.hit(); }));

  write_exr(files.exr.path(), image, {stats.camera, stats.scheme, stage.is_scene}, stats.threads);
  if (files.png) write_png(files.png->path(), beauty_picture(image));
  if (files.level_png) write_png(files.level_png->path(), level_map(image, view));
  stats.write_seconds = stopwatch.lap();
  if (files.stats) write_stats(files.stats->path(), stats);
  files.commit();
  print_summary(options, stats);
}

/// A picture's format is its option's: a name that ends in another's is a slip.
CLI::Validator is_not(const std::string& extension, const std::string& format) {
  return CLI::Validator(
      [=](const std::string& file) {
        return CLI::detail::to_lower(file).ends_with(extension) ? "'" + file + "' would be " + format : std::string();
      },
      "");
}

}  // namespace

int render(const RenderOptions& options) {
  run_with_threads(options.threads, [&options] { render_in_arena(options); });
  return exit_done;
}

void add_render(CLI::App& app, Command& command) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* sub = app.add_subcommand("render", "Render a picture of the limit surface");
  add_stage_options(*sub, options->model);
  add_method_options(*sub, options->scene);
  sub->add_option("-o,--output", options->exr,
                  "OpenEXR file with the channels R G B A (linear), Z (distance from the eye), N.X/Y/Z, P.X/Y/Z, "
                  "uv.U/V, face and level (UINT; 4294967295 where nothing was hit); of scenes, instance, too")
      ->required()
      ->check(is_not(".png", "an OpenEXR file; see --png"))
      ->type_name("FILE");
  sub->add_option("--png", options->png, "The same picture as PNG")
      ->check(is_not(".exr", "a PNG file; see -o"))
      ->type_name("FILE");
  sub->add_option("--png-level", options->level_png,
                  "PNG with a colour per refinement level; its legend adds columns on the right")
      ->check(is_not(".exr", "a PNG file; see -o"))
      ->type_name("FILE");
  sub->add_option_function<std::string>("--size", parse_into(options->size, parse_size, "--size"), "Size in pixels")
      ->type_name("WxH")
      ->default_str("800x800");
  sub->add_option_function<std::string>("--camera", parse_into(options->camera, parse_camera, "--camera"),
                                        "Eye, target, vertical opening angle in degrees, and up (default: y): "
                                        "ex,ey,ez,tx,ty,tz,fov[,ux,uy,uz] (default: "
                                        "the scene's; without one, frames all from the front, right and above, fov 40)")
      ->type_name("CAMERA");
  add_threads_option(*sub, options->threads);
  sub->add_option("--stats", options->stats, "JSON file with times, memory and counts of the work done")
      ->type_name("FILE");
  sub->callback([options, &command] {
    expect_distinct_files({{"--output", options->exr},
                           {"--png", options->png},
                           {"--png-level", options->level_png},
                           {"--stats", options->stats}},
                          inputs_of(options->model));
    command = [options] { return render(*options); };
  });
}

}  // namespace shaolin
