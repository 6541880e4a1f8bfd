// A memory budget costs work, never an answer; it is kept when queries are done, and bytes balance.
#include "intersect/patch_budget.h"

#include <atomic>
#include <thread>

#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"
#include "tests/plugins/plugin_files.h"

namespace shaolin {

namespace {

/// A mesh, and how to make an object of it.
struct Recipe {
  std::string name;
  ControlMesh mesh;
  std::string scheme;
  std::shared_ptr<const SchemeMasks> masks;  ///< of a plug-in; null: `scheme`
  SceneOptions options;

  std::shared_ptr<const Object> object(std::shared_ptr<PatchBudget> budget) const {
    SceneOptions with = options;
    with.budget = std::move(budget);
    return masks ? make_object(mesh, masks, with) : make_object(mesh, scheme, with);
  }
  Scene scene(std::shared_ptr<PatchBudget> budget) const { return Scene({Instance{object(std::move(budget))}}); }
};

SceneOptions by_chords(Method method) {
  SceneOptions options;
  options.method = method;
  options.chord.epsilon = 0.01;
  return options;
}

/// Both kinds of faces, creases, poles and n-gons, a scheme without polynomials, and all methods that refine lazily.
std::vector<Recipe> recipes() {
  ControlMesh creased = shaken(poles("catmark", 7), 0.2);
  creased.sharp_edges = {{0, 2, 10}, {0, 6, 1.5}, {1, 3, 2.5}};
  ControlMesh loop = shaken(poles("loop", 9), 0.2);
  loop.sharp_edges = {{0, 2, 10}, {0, 6, 10}, {1, 3, 2.5}};
  const ControlMesh irregular = shaken(poles("loop", 5), 0.2), prisms = shaken(prism(7), 0.1);
  return {{"creased", creased, "catmark", nullptr, {}},
          {"torus", shaken(torus("catmark", 9, 6), 0.1), "catmark", nullptr, {}},
          {"prism", prisms, "catmark", nullptr, {}},
          {"creased", loop, "loop", nullptr, {}},
          {"butterfly", irregular, "", load_plugin(test::example_plugin("butterfly")).masks, {}},
          {"chords", loop, "loop", nullptr, by_chords(Method::chord)},
          {"chords", prisms, "catmark", nullptr, by_chords(Method::chord)},
          {"a3", creased, "catmark", nullptr, by_chords(Method::a3)}};
}

Hits ask(const Scene& scene, const std::vector<Ray>& rays) {
  Hits answers;
  for (const Ray& ray : rays) answers.push_back(scene.intersect(ray));
  return answers;
}

/// All rays from each of some threads, which start together, each with another ray; returns how many answers are not
/// `expected`.
std::size_t differences_under_load(const Scene& scene, const std::vector<Ray>& rays, const Hits& expected,
                                   std::size_t threads) {
  std::atomic<std::size_t> ready{0}, wrong{0};
  std::vector<std::thread> running;
  for (std::size_t k = 0; k < threads; ++k)
    running.emplace_back([&, k] {
      for (++ready; ready < threads;) std::this_thread::yield();
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::size_t ray = (i + k * rays.size() / threads) % rays.size();
        wrong += !same(scene.intersect(rays[ray]), expected[ray]);
        wrong += scene.occluded(rays[ray]) != expected[ray].has_value();
      }
    });
  for (std::thread& thread : running) thread.join();
  return wrong;
}

/// What a scene came to hold without a budget is held under one, but for blocks of 64 places for start patches, of
/// eight objects at most: under a budget they are there from the start.
bool is_held_but_for_blocks(const PatchBudget& budget, std::uint64_t grown, std::uint64_t faces) {
  const std::uint64_t places = grown - budget.held(), block = 64 * sizeof(void*);
  return places >= block && places % block == 0 && places <= (faces / 64 + 8) * block;
}

/// Shares of what a recipe holds without a budget; the last one is less than any tree.
std::vector<std::uint64_t> budgets(std::uint64_t all) { return {all * 2, all / 2, all / 8, 1}; }

}  // namespace

TEST_CASE("A memory budget changes no answer and is kept", "[intersect][budget]") {
  for (const Recipe& recipe : recipes()) {
    CAPTURE(recipe.name, recipe.scheme);
    const Scene kept = recipe.scene(nullptr);
    const std::uint64_t empty = kept.statistics().bytes;
    const std::vector<Ray> rays = random_rays(kept.bounds(), 100, 81);
    const Hits expected = ask(kept, rays);
    const Statistics all = kept.statistics();
    CHECK(all.patches_evicted == 0);
    CHECK(all.hits > 5);
    for (const std::uint64_t bytes : budgets(all.bytes - empty)) {
      CAPTURE(bytes);
      const auto budget = std::make_shared<PatchBudget>(bytes);
      const Scene scene = recipe.scene(budget);
      const std::uint64_t before = scene.statistics().bytes;
      CHECK(differences(ask(scene, rays), expected) == 0);
      const Statistics work = scene.statistics();
      CHECK(budget->held() <= bytes);
      CHECK(work.bytes == before + budget->held());
      CHECK(work.faces_touched == all.faces_touched);
      CHECK(work.invalid_patches == all.invalid_patches);
      CHECK(work.unresolved_patches == all.unresolved_patches);
      CHECK(work.chord_tests == all.chord_tests);
      CHECK((work.patches_evicted > 0) == (bytes < all.bytes - empty));
      CHECK(work.patches_split >= all.patches_split);
      if (bytes == 1) CHECK(budget->held() == 0);
      if (bytes > all.bytes - empty) CHECK(is_held_but_for_blocks(*budget, all.bytes - empty, all.faces));
    }
  }
}

TEST_CASE("A memory budget holds under load", "[intersect][budget]") {
  for (const Recipe& recipe : recipes()) {
    CAPTURE(recipe.name, recipe.scheme);
    const Scene kept = recipe.scene(nullptr);
    const std::uint64_t empty = kept.statistics().bytes;
    const std::vector<Ray> rays = random_rays(kept.bounds(), 40, 82);
    const Hits expected = ask(kept, rays);
    for (const std::uint64_t bytes : budgets(kept.statistics().bytes - empty)) {
      CAPTURE(bytes);
      const auto budget = std::make_shared<PatchBudget>(bytes);
      {
        const Scene scene = recipe.scene(budget);
        const std::uint64_t before = scene.statistics().bytes;
        CHECK(differences_under_load(scene, rays, expected, 4) == 0);
        CHECK(budget->held() <= bytes);
        CHECK(scene.statistics().bytes == before + budget->held());
        CHECK(scene.statistics().faces_touched == kept.statistics().faces_touched);
        CHECK(differences(scene.intersect(std::span<const Ray>(rays)), expected) == 0);
        CHECK(budget->held() <= bytes);
      }
      CHECK(budget->held() == 0);
    }
  }
}

TEST_CASE("Under load there is twice the budget at most, and what queries that are underway need",
          "[intersect][budget]") {
  constexpr std::size_t threads = 4;
  const Recipe recipe = recipes()[1];
  const std::vector<Ray> rays = random_rays(recipe.scene(nullptr).bounds(), 500, 85);
  std::uint64_t most = 0;  // of one query
  for (const Ray& ray : rays) {
    const Scene cold = recipe.scene(nullptr);
    const std::uint64_t empty = cold.statistics().bytes;
    cold.intersect(ray);
    most = std::max(most, cold.statistics().bytes - empty);
  }
  const auto budget = std::make_shared<PatchBudget>(most);
  const Scene scene = recipe.scene(budget);
  std::vector<std::uint64_t> peaks(threads);
  std::vector<std::thread> running;
  for (std::uint64_t& peak : peaks)
    running.emplace_back([&] {
      for (int round = 0; round < 20; ++round)
        for (const Ray& ray : rays) {
          scene.intersect(ray);
          peak = std::max(peak, budget->held());
        }
    });
  for (std::thread& thread : running) thread.join();
  CHECK(scene.statistics().patches_evicted > 10000);
  CHECK(*std::max_element(peaks.begin(), peaks.end()) <= 2 * most + threads * most);
  CHECK(budget->held() <= most);
}

TEST_CASE("Objects share a memory budget", "[intersect][budget]") {
  const Recipe recipe = recipes()[1];
  const Scene alone = recipe.scene(nullptr);
  const std::uint64_t empty = alone.statistics().bytes;
  const std::vector<Ray> rays = random_rays(alone.bounds(), 300, 83);
  const Hits expected = ask(alone, rays);
  const std::uint64_t bytes = alone.statistics().bytes - empty;

  const auto budget = std::make_shared<PatchBudget>(bytes);  // enough for one
  const Scene first = recipe.scene(budget);
  const std::uint64_t tables = first.statistics().bytes;
  CHECK(differences(ask(first, rays), expected) == 0);
  CHECK(first.statistics().patches_evicted == 0);
  CHECK(is_held_but_for_blocks(*budget, bytes, alone.statistics().faces));
  {
    const Scene second = recipe.scene(budget);
    CHECK(differences(ask(second, rays), expected) == 0);
    CHECK(first.statistics().patches_evicted > 0);
    CHECK(budget->held() <= bytes);
    CHECK(first.statistics().bytes + second.statistics().bytes == 2 * tables + budget->held());
  }
  // An object takes what it held with it, and leaves the rest.
  CHECK(budget->held() == first.statistics().bytes - tables);
  CHECK(differences(ask(first, rays), expected) == 0);
}

TEST_CASE("Trees that rays come by stay before others", "[intersect][budget]") {
  const Recipe recipe = recipes()[1];
  const Scene alone = recipe.scene(nullptr);
  const std::uint64_t empty = alone.statistics().bytes;
  const std::vector<Ray> rays = random_rays(alone.bounds(), 400, 84);
  const Ray& again = rays.front();
  alone.intersect(again);
  const std::uint64_t one = alone.statistics().bytes - empty;
  ask(alone, rays);
  const std::uint64_t all = alone.statistics().bytes - empty;

  const auto budget = std::make_shared<PatchBudget>(std::max(2 * one, all / 2));
  const Scene scene = recipe.scene(budget);
  scene.intersect(again);
  std::uint64_t made_again = 0;
  for (const Ray& ray : rays) {
    scene.intersect(ray);
    const std::uint64_t before = scene.statistics().patches_split;
    scene.intersect(again);
    made_again += scene.statistics().patches_split - before;
  }
  CHECK(scene.statistics().patches_evicted > 0);
  CHECK(made_again < 40);  // of 400 times; 121 if what was made first went first
}

TEST_CASE("A memory budget that cannot be is refused", "[intersect][budget]") {
  CHECK_THROWS_WITH(PatchBudget(0), "a memory budget of 0 bytes is out of range; expected 1 or more");
  CHECK_THROWS_AS(PatchBudget(0), InputError);
  SceneOptions options;
  options.method = Method::uniform;
  options.budget = std::make_shared<PatchBudget>(1);
  CHECK_THROWS_AS(Scene(prism(5), "catmark", options), InputError);
  CHECK_THROWS_WITH(Scene(prism(5), "catmark", options),
                    "a tessellation takes no memory budget; expected another method, or none");
}

}  // namespace shaolin
