// Hits depend on the ray alone: not on threads, not on the order of rays, not on what other rays refined.
#include <algorithm>
#include <thread>

#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// All answers, asked for in the given order.
Hits ask(const Scene& scene, const std::vector<Ray>& rays, const std::vector<std::size_t>& order) {
  Hits answers(rays.size());
  for (const std::size_t i : order) answers[i] = scene.intersect(rays[i]);
  return answers;
}

/// Threads that take turns, so that they meet in the same patches while those are being made.
Hits ask_in_threads(const Scene& scene, const std::vector<Ray>& rays, std::size_t thread_count) {
  Hits answers(rays.size());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < thread_count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < rays.size(); i += thread_count) answers[i] = scene.intersect(rays[i]);
    });
  for (std::thread& thread : threads) thread.join();
  return answers;
}

std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::size_t> order(count);
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = i;
    std::swap(order[i], order[static_cast<std::size_t>(random.index(static_cast<int>(i) + 1))]);
  }
  return order;
}

/// Half of the rays at random; the others meet vertices of the surface, where several patches answer and ties are
/// broken by a rule.
std::vector<Ray> rays_for(const Scene& scene) {
  const LimitSurface& surface = scene.surface();
  std::vector<Ray> rays = random_rays(scene.bounds(), 150, 11);
  Random random(12);
  const double distance = (scene.bounds().upper - scene.bounds().lower).norm();
  while (rays.size() < 300) {
    const int face = random.index(surface.face_count());
    const auto sample = surface.evaluate({face, 0, 0, 0});
    if (!sample) continue;
    const Vec3 direction = random.direction();
    rays.push_back({sample->position - distance * direction, direction, 0, 2 * distance});
  }
  return rays;
}

}  // namespace

TEST_CASE("Hits are the same for any threads, order and cache", "[intersect][scene][sweep]") {
  for (const Model& model : all_models()) {
    if (model.mesh.face_count() > 1000) continue;  // fresh scenes for all would take minutes
    CAPTURE(model.name, model.scheme);
    const Scene scene(model.mesh, model.scheme);
    const std::vector<Ray> rays = rays_for(scene);
    std::vector<std::size_t> order(rays.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;

    const Hits first = ask(scene, rays, order);
    REQUIRE(std::count(first.begin(), first.end(), std::nullopt) < 250);
    CHECK(differences(first, ask(scene, rays, order)) == 0);  // the cache is warm now
    const Scene other(model.mesh, model.scheme);
    CHECK(differences(first, ask(other, rays, shuffled(rays.size(), 13))) == 0);
    const Scene shared(model.mesh, model.scheme);
    CHECK(differences(first, ask_in_threads(shared, rays, 4)) == 0);
    for (std::size_t i = 0; i < rays.size(); i += 10) {
      const Scene cold(model.mesh, model.scheme);
      CAPTURE(i);
      CHECK(same(first[i], cold.intersect(rays[i])));
    }
  }
}

TEST_CASE("Threads count their work together and refine no more than one does", "[intersect][scene]") {
  const ControlMesh mesh = shaken(poles("catmark", 7), 0.1);
  const Scene alone(mesh, "catmark"), shared(mesh, "catmark");
  const std::vector<Ray> rays = random_rays(alone.bounds(), 400, 14);
  ask_in_threads(alone, rays, 1);
  ask_in_threads(shared, rays, 4);
  const Statistics a = alone.statistics(), b = shared.statistics();
  CHECK(b.rays == 400);
  CHECK(b.hits == a.hits);
  CHECK(b.faces_touched == a.faces_touched);
  CHECK(b.bytes > 0);
  // A patch that two threads split at once is kept, and counted, once. Rays that find children known skip the hull test
  // of the parent, but what that would have dropped the children's tests drop too: the same patches split.
  CHECK(b.patches_split == a.patches_split);
}

TEST_CASE("Occluded agrees with intersect", "[intersect][scene]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    const Scene scene(shaken(torus(scheme, 5, 7), 0.1), scheme);
    int hits = 0, disagree = 0;
    Random random(15);
    for (Ray ray : random_rays(scene.bounds(), 500, 16)) {
      ray.tmin = random.uniform(-0.5, 1);
      ray.tmax = ray.tmin + random.uniform(0, 1.5);
      const bool hit = scene.intersect(ray).has_value();
      hits += hit;
      disagree += hit != scene.occluded(ray);
    }
    CAPTURE(scheme);
    CHECK(hits > 100);
    CHECK(hits < 400);
    CHECK(disagree == 0);
  }
}

}  // namespace shaolin
