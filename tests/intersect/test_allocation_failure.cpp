// Out of memory at any allocation of a query: std::bad_alloc, and a scene that answers as if nothing had been.
#include <algorithm>
#include <functional>
#include <new>

#include "intersect/patch_budget.h"
#include "intersect/scene.h"
#include "tests/allocation.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/meshes.h"

namespace shaolin {

namespace {

/// Irregular vertices, a semi-sharp crease and a sharp one, n-gons or a boundary: every kind of patch.
struct Case {
  std::string scheme;
  ControlMesh mesh;
  bool has_budget = false;
};

std::vector<Case> cases() {
  const ControlMesh creased = with_edges(shaken(cube(), 0.1), {{0, 1, 2.5F}, {1, 2, 10}});
  return {{"catmark", creased},
          {"catmark", shaken(prism(5), 0.1), true},
          {"loop", with_edges(tetrahedron(), {{0, 1, 1.5F}})},
          {"warren", sheet("loop", 3, 3)}};
}

Scene scene_of(const Case& it) {
  SceneOptions options;
  if (it.has_budget) options.budget = std::make_shared<PatchBudget>(20000);
  Affine map = Affine::Identity();
  map.translation().x() = 0.25;
  return Scene({{make_object(it.mesh, it.scheme, options), map}});
}

/// Which allocations fail: each, or the first 32 and then fewer and fewer.
enum class Choice { each, some };

/// Runs the query with one of its allocations failing after the other, on a scene that no query has met, and expects
/// the scene to answer after it as one does where none fails. Returns how many allocations there were.
template <class Answer>
std::size_t fail_allocations(const Case& it, Choice choice, const std::function<Answer(const Scene&)>& query,
                             const std::function<bool(const Answer&, const Answer&)>& same) {
  const Answer expected = query(scene_of(it));
  constexpr std::size_t most = 100000;
  for (std::size_t number = 0; number < most; number += choice == Choice::each ? 1 : 1 + number / 32) {
    const Scene scene = scene_of(it);
    bool has_failed = false;
    {
      const FailingAllocation failing(number);
      try {
        // It may not matter: std::stable_sort sorts without a buffer, then.
        const Answer answer = query(scene);
        REQUIRE(same(answer, expected));
        if (!failing.failed()) return number;
      } catch (const std::bad_alloc&) {
        has_failed = true;
      }
      REQUIRE(failing.failed());
    }
    CAPTURE(number, has_failed);
    REQUIRE(same(query(scene), expected));
  }
  return most;
}

Ray hitting_ray(const Case& it) {
  const Scene scout = scene_of(it);
  const std::vector<Ray> rays = random_rays(scout.bounds(), 40, 5);
  return *std::find_if(rays.begin(), rays.end(), [&](const Ray& ray) { return scout.intersect(ray).has_value(); });
}

}  // namespace

TEST_CASE("An allocation that fails in a query is a clean error", "[intersect][allocation]") {
  for (const Case& it : cases()) {
    CAPTURE(it.scheme);
    const Ray ray = hitting_ray(it);
    CHECK(fail_allocations<std::optional<Hit>>(
              it, Choice::some, [&](const Scene& scene) { return scene.intersect(ray); },
              [](const auto& a, const auto& b) { return same(a, b); }) > 20);
    fail_allocations<bool>(
        it, Choice::some, [&](const Scene& scene) { return scene.occluded(ray); }, std::equal_to<>());
    fail_allocations<std::size_t>(
        it, Choice::some, [&](const Scene& scene) { return scene.all_hits(ray).size(); }, std::equal_to<>());
    const Hit hit = *scene_of(it).intersect(ray);
    fail_allocations<double>(
        it, Choice::some,
        [&](const Scene& scene) {
          Hit uncertified = hit;
          uncertified.certificate = {};
          return scene.certify(ray, uncertified).error;
        },
        std::equal_to<>());
    CHECK(fail_allocations<double>(
              it, Choice::some, [&](const Scene& scene) { return scene.closest_point(ray.origin)->distance; },
              std::equal_to<>()) > 20);
    fail_allocations<bool>(
        it, Choice::some,
        [&](const Scene& scene) {
          return scene.overlaps(Capsule{ray.origin, scene.bounds().centre(), 0.1}).has_value();
        },
        std::equal_to<>());
  }
}

TEST_CASE("Each allocation of a query may fail", "[intersect][allocation][sweep]") {
  const std::vector<Case> all = cases();
  for (const Case& it : {all[1], all[2]}) {
    CAPTURE(it.scheme);
    const Ray ray = hitting_ray(it);
    fail_allocations<std::optional<Hit>>(
        it, Choice::each, [&](const Scene& scene) { return scene.intersect(ray); },
        [](const auto& a, const auto& b) { return same(a, b); });
  }
}

TEST_CASE("An allocation that fails while a scene is built leaves nothing behind", "[intersect][allocation]") {
  // Leaks are the sanitizers' to find.
  const ControlMesh mesh = shaken(cube(), 0.1);
  std::size_t number = 0;
  for (bool has_failed = true; has_failed; ++number) {
    ControlMesh given = mesh;
    const FailingAllocation failing(number);
    try {
      const Scene scene(std::move(given), "catmark");
      has_failed = failing.failed();
    } catch (const std::bad_alloc&) {
      has_failed = failing.failed();
      REQUIRE(has_failed);
    }
  }
  CHECK(number > 50);
}

}  // namespace shaolin
