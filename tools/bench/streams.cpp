/// Whether the order of rays matters: random rays one by one, as they come, and as a stream, which Scene sorts:
/// shaolin_bench_streams MODEL...
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "intersect/scene.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"
#include "tools/validate/random.h"

namespace shaolin {
namespace {

/// From around the box to points in it.
std::vector<Ray> random_rays(const Box& box, std::size_t count) {
  SampleRandom random(1);
  const double diagonal = (box.upper - box.lower).norm();
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    ray.origin = box.centre() + random.between(0.6, 3) * diagonal * random.direction();
    ray.direction = random.inside(box.lower, box.upper) - ray.origin;
  }
  return rays;
}

double nanoseconds_each(std::size_t count, const auto& run) {
  const auto start = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
         static_cast<double>(count);
}

void print(const std::string& file, std::size_t count, int runs) {
  const ControlMesh mesh = read_obj(file);
  const std::string scheme = default_scheme(mesh);
  const Scene scene(mesh, scheme);
  const std::vector<Ray> rays = random_rays(scene.bounds(), count);
  const auto first = scene.intersect(rays);  // refines what the rays need
  const std::size_t hits = static_cast<std::size_t>(
      std::count_if(first.begin(), first.end(), [](const auto& hit) { return hit.has_value(); }));
  std::vector<double> single, stream, ratio;
  for (int run = 0; run < runs; ++run) {
    std::vector<std::optional<Hit>> hits_of(rays.size());
    single.push_back(nanoseconds_each(count, [&] {
      for (std::size_t i = 0; i < rays.size(); ++i) hits_of[i] = scene.intersect(rays[i]);
    }));
    stream.push_back(nanoseconds_each(count, [&] { hits_of = scene.intersect(rays); }));
    ratio.push_back(single.back() / stream.back());
  }
  for (std::vector<double>* const times : {&single, &stream, &ratio}) std::sort(times->begin(), times->end());
  const std::size_t middle = ratio.size() / 2;
  std::printf("%-28s %-8s %9zu %9zu %10.0f %10.0f %7.2f %7.2f %7.2f\n", file.substr(file.rfind('/') + 1).c_str(),
              scheme.c_str(), count, hits, single[middle], stream[middle], ratio[middle], ratio.front(), ratio.back());
  std::fflush(stdout);
}

}  // namespace
}  // namespace shaolin

int main(int argc, char** argv) {
  CLI::App app("SampleRandom rays one by one and as a stream: median times, and the ratio's median, least and most",
               "shaolin_bench_streams");
  std::vector<std::string> files;
  std::size_t rays = 200000;
  int runs = 5, threads = 1;
  app.add_option("MODEL", files, "Control meshes")->required();
  app.add_option("--rays", rays, "Rays at each model")->check(CLI::Range(1, 100000000))->capture_default_str();
  app.add_option("--runs", runs, "Runs of each, in turns")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--threads", threads, "Of streams; single rays have one")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  try {
    std::printf("%-28s %-8s %9s %9s %10s %10s %7s %7s %7s\n", "model", "scheme", "rays", "hits", "single, ns",
                "stream, ns", "ratio", "least", "most");
    for (const std::string& file : files) shaolin::print(file, rays, runs);
  } catch (const std::exception& error) {
    std::cerr << "shaolin_bench_streams: error: " << error.what() << '\n';
    return 3;
  }
  return 0;
}
