/// The time to the first image: from a model's file to pixels, cold, on one thread, ours against Embree 3.
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "intersect/scene.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"
#include "tools/bench/child_process.h"
#include "tools/bench/embree_scene.h"
#include "tools/cli/camera.h"
#include "tools/cli/command.h"
#include "tools/cli/render_stats.h"

namespace shaolin {
namespace {

struct Options {
  std::vector<std::string> models;
  std::string scheme;
  std::string size = "800x800";
  int runs = 3;
  int level = 5;
};

/// What all runs on one model share.
struct Job {
  std::string model, scheme;
  ImageSize size;
  int level = 5;
  Camera camera{};
  double diagonal = 0;  ///< of the scene's bounds

  std::size_t pixel_count() const {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
  }
};

struct Pixel {
  float brightness = 0;
  float depth = 0;  ///< distance from the eye; 0: nothing was hit
};

struct Sample {
  double seconds = 0;
  std::size_t peak_bytes = 0;
};

/// Our scene behind the two calls that the image needs, as EmbreeScene has them.
class OurScene {
 public:
  explicit OurScene(const Job& job, ControlMesh mesh) : scene_(std::move(mesh), job.scheme) {}

  std::optional<EmbreeScene::Hit> intersect(const Ray& ray) const {
    const std::optional<Hit> hit = scene_.intersect(ray);
    if (!hit) return std::nullopt;
    return EmbreeScene::Hit{hit->t, hit->sample.normal};
  }
  bool occluded(const Ray& ray) const { return scene_.occluded(ray); }
  Statistics statistics() const { return scene_.statistics(); }

 private:
  Scene scene_;
};

/// One primary ray per pixel and, where it hits, one shadow ray.
template <typename Tracer>
void draw(const Tracer& tracer, const Job& job, std::span<Pixel> pixels) {
  const View view(job.camera, job.size);
  const Vec3 light = (view.up() - 0.7 * view.right() - 0.8 * view.forward()).normalized();
  // Off the surface by more than Embree's single precision is wrong, by less than a pixel shows.
  const double offset = 1e-4 * job.diagonal;
  auto pixel = pixels.begin();
  for (int y = 0; y < job.size.height; ++y) {
    for (int x = 0; x < job.size.width; ++x, ++pixel) {
      const Ray ray = view.ray(x, y);
      const auto hit = tracer.intersect(ray);
      if (!hit) continue;
      const Vec3 normal = hit->normal.dot(ray.direction) <= 0 ? hit->normal : Vec3(-hit->normal);
      Ray shadow;
      shadow.origin = ray.origin + hit->t * ray.direction + offset * normal;
      shadow.direction = light;
      const double incidence = normal.dot(light);
      const bool lit = !tracer.occluded(shadow) && incidence > 0;
      pixel->brightness = static_cast<float>(lit ? 0.2 + 0.8 * incidence : 0.2);
      pixel->depth = static_cast<float>(hit->t);
    }
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Sample draw_ours(const Job& job, std::span<Pixel> pixels, Statistics& statistics) {
  SharedArray<double> seconds(1);
  SharedArray<Statistics> work(1);
  const std::size_t peak = run_in_child([&] {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    Stopwatch stopwatch;
    const OurScene scene(job, read_obj(job.model));
    draw(scene, job, pixels);
    seconds.values()[0] = stopwatch.lap();
    work.values()[0] = scene.statistics();
  });
  statistics = work.values()[0];
  return {seconds.values()[0], peak};
}

Sample draw_embree(const Job& job, std::span<Pixel> pixels) {
  SharedArray<double> seconds(1);
  const std::size_t peak = run_in_child([&] {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    Stopwatch stopwatch;
    const EmbreeScene scene(read_obj(job.model), job.scheme, job.level);
    draw(scene, job, pixels);
    seconds.values()[0] = stopwatch.lap();
  });
  return {seconds.values()[0], peak};
}

/// How far the two images are apart.
struct Difference {
  std::size_t hits = 0;         ///< pixels that either image hits
  std::size_t hit_or_miss = 0;  ///< pixels that only one of them hits
  double median_depth = 0;      ///< of |difference| where both hit, in diagonals

  /// Embree's surface is a polyhedron on the limit surface, in single precision: outlines differ by parts of a pixel
  /// and depths by the polyhedron's sagitta. Another surface (a wrong tag, a wrong boundary) differs by far more.
  bool same_surface() const {
    return hits > 0 && static_cast<double>(hit_or_miss) <= 0.03 * static_cast<double>(hits) + 4 && median_depth <= 2e-3;
  }
};

Difference compare(const Job& job, std::span<const Pixel> ours, std::span<const Pixel> theirs) {
  Difference difference;
  std::vector<double> depths;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const bool a = ours[i].depth > 0, b = theirs[i].depth > 0;
    difference.hits += a || b;
    difference.hit_or_miss += a != b;
    if (a && b) depths.push_back(std::abs(static_cast<double>(ours[i].depth) - theirs[i].depth) / job.diagonal);
  }
  if (!depths.empty()) difference.median_depth = median(std::move(depths));
  return difference;
}

/// The model's default camera, found in a child: our scene leaves no trace in the processes that are measured.
Job make_job(const std::string& model, const Options& options) {
  Job job{.model = model, .scheme = options.scheme, .size = parse_size(options.size), .level = options.level};
  ControlMesh mesh = read_obj(model);
  if (job.scheme.empty()) job.scheme = default_scheme(mesh);
  SharedArray<Camera> camera(1);
  SharedArray<double> diagonal(1);
  run_in_child([&] {
    const Scene scene(std::move(mesh), job.scheme);
    const Box bounds = scene.bounds();
    camera.values()[0] = default_camera(bounds, job.size);
    diagonal.values()[0] = (bounds.upper - bounds.lower).norm();
  });
  job.camera = camera.values()[0];
  job.diagonal = diagonal.values()[0];
  return job;
}

std::vector<double> seconds_of(const std::vector<Sample>& samples) {
  std::vector<double> seconds;
  for (const Sample& sample : samples) seconds.push_back(sample.seconds);
  return seconds;
}

std::string seconds_cell(const std::vector<Sample>& samples) {
  const std::vector<double> seconds = seconds_of(samples);
  const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
  char cell[96];
  std::snprintf(cell, sizeof cell, "%.3f (%.3f to %.3f)", median(seconds), *least, *most);
  return cell;
}

double most_mebibytes(const std::vector<Sample>& samples) {
  std::size_t most = 0;
  for (const Sample& sample : samples) most = std::max(most, sample.peak_bytes);
  return static_cast<double>(most) / (1024.0 * 1024.0);
}

void print_header() {
  std::cout << "| model | scheme | ours s, median (min to max) | Embree s, median (min to max) | ours / Embree "
               "| ours MiB | Embree MiB | patches split | faces never touched | pixels hit | hit by one only "
               "| median depth difference, diagonals |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

void print_row(const Job& job, const std::vector<Sample>& ours, const std::vector<Sample>& theirs,
               const Statistics& statistics, const Difference& difference) {
  char row[512];
  std::snprintf(row, sizeof row, "| %s | %s | %s | %s | %.2f | %.0f | %.0f | %llu | %llu of %llu | %zu | %zu | %.1e |",
                std::filesystem::path(job.model).stem().c_str(), job.scheme.c_str(), seconds_cell(ours).c_str(),
                seconds_cell(theirs).c_str(), median(seconds_of(ours)) / median(seconds_of(theirs)),
                most_mebibytes(ours), most_mebibytes(theirs), static_cast<unsigned long long>(statistics.patches_split),
                static_cast<unsigned long long>(statistics.faces - statistics.faces_touched),
                static_cast<unsigned long long>(statistics.faces), difference.hits, difference.hit_or_miss,
                difference.median_depth);
  std::cout << row << std::endl;
}

/// False if the two did not draw the same surface: then the times say nothing, and no row is printed.
bool race(const Job& job, int runs) {
  SharedArray<Pixel> our_pixels(job.pixel_count()), their_pixels(job.pixel_count());
  std::vector<Sample> ours, theirs;
  Statistics statistics;
  Difference difference;
  for (int run = 0; run < runs; ++run) {  // in turns, so that a busy moment of the machine meets both
    ours.push_back(draw_ours(job, our_pixels.values(), statistics));
    theirs.push_back(draw_embree(job, their_pixels.values()));
    if (run > 0) continue;
    difference = compare(job, our_pixels.values(), their_pixels.values());
    if (!difference.same_surface()) {
      std::cerr << job.model << ": the images differ: " << difference.hit_or_miss << " of " << difference.hits
                << " pixels are hit by one only, median depth difference " << difference.median_depth << " diagonals\n";
      return false;
    }
  }
  print_row(job, ours, theirs, statistics, difference);
  return true;
}

/// What is wrong with a --size; empty if nothing is.
std::string size_fault(const std::string& text) {
  try {
    parse_size(text);
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

int run(const Options& options) {
  try {
    bool all_same = true;
    print_header();
    for (const std::string& model : options.models) all_same &= race(make_job(model, options), options.runs);
    return all_same ? exit_done : exit_check_failed;
  } catch (const std::exception& error) {
    std::cerr << "shaolin_bench_first_image: error: " << error.what() << '\n';
    return exit_bad_input;
  }
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  shaolin::Options options;
  CLI::App app(
      "Cold single-threaded images, from file to pixels: ours against Embree's subdivision geometry (Catmull-Clark) or "
      "Embree's triangles on a uniform tessellation (Loop). Every run is a process of its own. Prints a Markdown "
      "table; "
      "exits with 1 if the two did not draw the same surface.");
  app.add_option("MODEL", options.models, "OBJ files")->required();
  app.add_option("--scheme", options.scheme, "loop or catmark; default: what the mesh asks for")
      ->check(CLI::IsMember({"loop", "catmark"}));
  app.add_option("--size", options.size, "WxH")->check(shaolin::size_fault)->capture_default_str();
  app.add_option("--runs", options.runs, "Runs of each")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--level", options.level, "Embree's level: 2^level segments along an edge")
      ->check(CLI::Range(0, 10))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? shaolin::exit_done : shaolin::exit_usage;
  }
  return shaolin::run(options);
}
