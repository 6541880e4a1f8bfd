// Refinement is lazy: a scene's counters show that it works where rays go, and there only.
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

TEST_CASE("Rays that meet no box refine nothing", "[intersect][scene]") {
  const Scene scene(poles("catmark", 9), "catmark");
  const std::uint64_t before = scene.statistics().bytes;
  CHECK(before > 0);
  for (Ray ray : random_rays(scene.bounds(), 200, 31)) {
    ray.direction = (ray.origin - scene.bounds().centre()).normalized();
    CHECK(!scene.intersect(ray));
    CHECK(!scene.occluded(ray));
  }
  const Statistics work = scene.statistics();
  CHECK(work.rays == 400);
  CHECK(work.hits == 0);
  CHECK(work.faces_touched == 0);
  CHECK(work.patches_split == 0);
  CHECK(work.hull_tests == 0);
  CHECK(work.cells == 0);
  CHECK(work.bytes == before);
}

TEST_CASE("One ray touches few faces and splits few patches", "[intersect][scene]") {
  const ControlMesh mesh = shaken(torus("catmark", 30, 40), 0.002);
  for (const Ray& ray : random_rays(Scene(mesh, "catmark").bounds(), 50, 32)) {
    const Scene scene(mesh, "catmark");
    const std::uint64_t before = scene.statistics().bytes;
    const auto hit = scene.intersect(ray);
    const Statistics work = scene.statistics();
    CHECK(work.faces == 1200);
    CHECK(work.hits == (hit ? 1 : 0));
    // A face's box is about twice as wide as the face: a straight line through the first of up to four sheets meets
    // some 4 of them, several times as many where it grazes.
    CHECK(work.faces_touched <= 48);
    // These patches are nearly flat: none needs more than two levels of splits.
    CHECK(work.patches_split <= 5 * work.faces_touched);
    CHECK((work.bytes > before) == (work.faces_touched > 0));
  }
}

TEST_CASE("What is refined is kept", "[intersect][scene]") {
  const Scene scene(shaken(poles("loop", 7), 0.1), "loop");
  const std::vector<Ray> rays = random_rays(scene.bounds(), 200, 33);
  for (const Ray& ray : rays) scene.intersect(ray);
  const Statistics first = scene.statistics();
  for (const Ray& ray : rays) scene.intersect(ray);
  const Statistics second = scene.statistics();
  CHECK(first.hits > 50);
  CHECK(first.faces == 14);
  CHECK(first.faces_touched == 14);
  CHECK(first.patches_split > 14);  // every face has an irregular corner
  CHECK(second.rays == 2 * first.rays);
  CHECK(second.hits == 2 * first.hits);
  CHECK(second.patches_split == first.patches_split);
  CHECK(second.bytes == first.bytes);
}

TEST_CASE("An n-gon counts once per corner, a face without limit not at all", "[intersect][scene]") {
  CHECK(Scene(prism(5), "catmark").statistics().faces == 5 + 5 + 5);
  ControlMesh mesh = prism(5);
  mesh.holes = {0, 2};
  CHECK(Scene(mesh, "catmark").statistics().faces == 5 + 4);
  mesh = sheet("catmark", 5, 4);
  mesh.boundary = BoundaryInterpolation::none;
  CHECK(Scene(mesh, "catmark").statistics().faces == 3 * 2);
}

}  // namespace shaolin
