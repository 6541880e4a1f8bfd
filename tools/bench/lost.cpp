#include "tools/bench/lost.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "tools/cli/command.h"
#include "tools/cli/render_stats.h"
#include "tools/cli/threads.h"
#include "tools/validate/sampling.h"

namespace shaolin {
namespace {

constexpr std::size_t block = 100000;  ///< rays that are held at a time

/// Rays at one instance, in the world's space; every second with a footprint.
std::vector<Ray> rays_at(const Scene& scene, int instance, std::size_t count, std::uint64_t seed) {
  const double pixel = 2 * std::tan(20 * std::numbers::pi / 180) / 800;  // of a camera with fov 40, 800 rows
  const Affine& map = scene.instances()[static_cast<std::size_t>(instance)].transform;
  std::vector<Ray> rays;
  for (const ProbeRay& probe : sample_rays(SampledSurface::of(scene.surface(instance)), count, seed)) {
    Ray ray = probe.ray;
    ray.origin = map * ray.origin;
    ray.direction = map.linear() * ray.direction;
    if (rays.size() % 2 == 0) ray.footprint.growth = pixel;
    rays.push_back(ray);
  }
  return rays;
}

void print_ray(const Ray& ray) {
  for (const Vec3& vector : {ray.origin, ray.direction})
    for (int axis = 0; axis < 3; ++axis) std::printf("%.17g,", vector[axis]);
  std::printf("%.17g,%.17g", ray.tmin, ray.tmax);
}

/// False if there are answers outside of the band.
bool check_model(const std::filesystem::path& file, const LostOptions& options) {
  Stopwatch stopwatch;
  const ModelOptions model{file, {}, {}};
  const Stage stage = load_stage(model);
  const auto build = [&](const Contender& contender) {
    Stage copy = stage;
    return build_scene(copy, scene_options(contender));
  };
  const Scene exact = build({});
  const Box bounds = exact.bounds();
  const double unit = options.unit.value_or(unit_of(model, (bounds.upper - bounds.lower).norm()));
  const double max_size = std::max(options.min_size, options.max_size.value_or(max_size_of(model)));
  const Contender contender{.kind = options.a3 ? ContenderKind::a3 : ContenderKind::chord,
                            .epsilon = options.epsilon,
                            .chord = {options.epsilon * unit, options.min_size, max_size}};
  const Scene chords = build(contender);

  ErrorFigures total;
  const std::size_t instances = exact.instances().size(), each = (options.rays + instances - 1) / instances;
  std::uint64_t seed = options.seed;
  for (std::size_t instance = 0; instance < instances; ++instance)
    for (std::size_t done = 0; done < each; done += block) {
      const auto rays = rays_at(exact, static_cast<int>(instance), std::min(block, each - done), seed++);
      total.add_counts(compare(contender, exact, rays, trace(rays, exact), trace(rays, chords)));
    }
  std::printf("%-28s %9.3g %10zu %10zu %8zu %8zu %8zu %8zu %8zu %8zu %8.1f\n", file.stem().c_str(),
              contender.chord.epsilon, total.rays, total.hits, total.lost, total.ghosts, total.farther, total.nearer,
              total.lost_outside, total.ghosts_outside, stopwatch.lap());
  for (const Ray& ray : total.outside) {
    std::printf("    outside: ");
    print_ray(ray);
    std::printf("%s\n", ray.footprint.growth > 0 ? "  (with a pixel's footprint)" : "");
  }
  std::fflush(stdout);
  return total.lost_outside + total.ghosts_outside == 0;
}

}  // namespace

int bench_lost(const LostOptions& options) {
  bool passed = true;
  std::printf("%-28s %9s %10s %10s %8s %8s %8s %8s %8s %8s %8s\n", "model", "epsilon", "rays", "hits", "lost", "ghosts",
              "farther", "nearer", "lost out", "gh. out", "seconds");
  run_with_threads(options.threads, [&] {
    for (const auto& model : options.models) passed &= check_model(model, options);
  });
  std::printf("%s\n", passed ? "PASS" : "FAIL");
  return passed ? exit_done : exit_check_failed;
}

}  // namespace shaolin
