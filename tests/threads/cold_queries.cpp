// Threads that ask cold objects at once, each in its own order: answers are those of one thread. Built by the preset
// `threads` it is what the thread sanitizer watches; it needs no test framework, whose code would be watched, too.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

#include "intersect/patch_budget.h"
#include "intersect/scene.h"
#include "tests/intersect/random_rays.h"
#include "tests/meshes.h"

namespace shaolin {
namespace {

/// What one ray and its origin get, as numbers to compare.
std::vector<double> answers(const Scene& scene, const Ray& ray, Method method) {
  std::vector<double> numbers;
  const auto hit = scene.intersect(ray);
  numbers.push_back(hit ? hit->t : -1);
  if (hit) numbers.push_back(scene.certify(ray, *hit).is_certified());
  numbers.push_back(scene.occluded(ray));
  if (method != Method::exact) return numbers;
  for (const Crossing& crossing : scene.all_hits(ray)) numbers.push_back(crossing.hit.t);
  numbers.push_back(scene.closest_point(ray.origin)->distance);
  return numbers;
}

Scene make_scene(Method method, bool has_budget) {
  SceneOptions options;
  options.method = method;
  options.level = 2;
  options.chord.epsilon = 0.02;
  if (has_budget) options.budget = std::make_shared<PatchBudget>(30000);
  const ControlMesh creased = with_edges(shaken(prism(5), 0.1), {{0, 1, 2.5F}, {1, 2, 10}});
  Affine aside = Affine::Identity();
  aside.translation() << 1.5, 0.2, -0.3;
  return Scene({{make_object(creased, "catmark", options)}, {make_object(tetrahedron(), "loop", options), aside}});
}

int race(Method method, bool has_budget, int rounds) {
  const std::vector<Ray> rays = random_rays(make_scene(method, false).bounds(), 60, 11);
  std::vector<std::vector<double>> expected;
  {
    const Scene alone = make_scene(method, false);
    for (const Ray& ray : rays) expected.push_back(answers(alone, ray, method));
  }
  constexpr std::size_t threads = 4;
  std::atomic<int> wrong{0};
  for (int round = 0; round < rounds; ++round) {
    const Scene scene = make_scene(method, has_budget);
    std::atomic<std::size_t> ready{0};
    std::vector<std::thread> running;
    for (std::size_t k = 0; k < threads; ++k)
      running.emplace_back([&, k] {
        for (++ready; ready < threads;) std::this_thread::yield();
        for (std::size_t i = 0; i < rays.size(); ++i) {
          const std::size_t ray = k % 2 == 0 ? i : rays.size() - 1 - i;
          if (answers(scene, rays[ray], method) != expected[ray]) ++wrong;
        }
      });
    for (std::thread& thread : running) thread.join();
  }
  return wrong;
}

}  // namespace
}  // namespace shaolin

int main() {
  using shaolin::Method;
  int wrong = 0;
  for (const Method method : {Method::exact, Method::chord, Method::a3, Method::uniform}) {
    wrong += shaolin::race(method, false, 3);
    if (method != Method::uniform) wrong += shaolin::race(method, true, 3);
  }
  std::printf("%d wrong answers\n", wrong);
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
