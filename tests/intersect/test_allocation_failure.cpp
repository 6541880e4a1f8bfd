// Out of memory at any allocation of a query: std::bad_alloc, and a scene that answers as if nothing had been.
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

/// Runs the query with each of its allocations failing in turn, on a scene that no query has met, and expects the scene
/// to answer `expected` after it. Returns how many there were.
template <class Answer>
std::size_t fail_each_allocation(const Case& it, const std::function<Answer(const Scene&)>& query,
                                 const std::function<bool(const Answer&, const Answer&)>& same) {
  const Answer expected = query(scene_of(it));
  constexpr std::size_t most = 100000;
  for (std::size_t number = 0; number < most; ++number) {
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

}  // namespace

TEST_CASE("An allocation that fails in a query is a clean error", "[intersect][allocation]") {
  for (const Case& it : cases()) {
    CAPTURE(it.scheme);
    const Box box = scene_of(it).bounds();
    std::vector<Ray> rays;
    {
      const Scene scout = scene_of(it);
      for (const Ray& ray : random_rays(box, 40, 5))
        if (rays.size() < 2 && scout.intersect(ray)) rays.push_back(ray);
    }
    REQUIRE(rays.size() == 2);
    std::size_t closest_ray = 0, closest_point = 0;
    for (const Ray& ray : rays) {
      closest_ray += fail_each_allocation<std::optional<Hit>>(
          it, [&](const Scene& scene) { return scene.intersect(ray); },
          [](const auto& a, const auto& b) { return same(a, b); });
      fail_each_allocation<bool>(
          it, [&](const Scene& scene) { return scene.occluded(ray); }, std::equal_to<>());
      fail_each_allocation<std::size_t>(
          it, [&](const Scene& scene) { return scene.all_hits(ray).size(); }, std::equal_to<>());
      closest_point += fail_each_allocation<double>(
          it, [&](const Scene& scene) { return scene.closest_point(ray.origin)->distance; }, std::equal_to<>());
    }
    CHECK(closest_ray > 20);
    CHECK(closest_point > 20);
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
      CHECK(!has_failed);
    } catch (const std::bad_alloc&) {
      has_failed = failing.failed();
      REQUIRE(has_failed);
    }
  }
  CHECK(number > 50);
}

}  // namespace shaolin
