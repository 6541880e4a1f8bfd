/// The peer draws the surfaces that it is raced on.
#include <cmath>

#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/tools/cli_run.h"
#include "tools/bench/embree_stage.h"

namespace shaolin::test {

namespace {

struct Comparison {
  int hits = 0, differ = 0;  ///< rays that both hit; rays whose answers differ (at outlines and contacts by a sheet)
};

/// Random rays at both; distances may differ by so many diagonals, normals by so much.
Comparison compare(const Scene& ours, const EmbreeStage& theirs, double distance, double normal) {
  const double diagonal = (ours.bounds().upper - ours.bounds().lower).norm();
  Comparison result;
  for (const Ray& ray : random_rays(ours.bounds(), 3000, 5)) {
    const auto a = ours.intersect(ray);
    const auto b = theirs.intersect(ray);
    result.differ += a.has_value() != b.has_value() || theirs.occluded(ray) != b.has_value();
    if (!a || !b) continue;
    ++result.hits;
    result.differ += std::abs(a->t - b->t) * ray.direction.norm() > distance * diagonal ||
                     (a->sample.normal - b->normal).norm() > normal;
  }
  return result;
}

}  // namespace

// Groups, a mirrored and an uneven transform, both kinds of faces.
TEST_CASE("Embree's variant of Uniform meets the same triangles", "[tools][bench][sweep]") {
  const int level = GENERATE(1, 4);
  const Stage stage = load_stage({data_file("scenes/mirrors.json"), {}, {}});
  SceneOptions options;
  options.method = Method::uniform;
  options.level = level;
  Stage copy = stage;
  const Scene ours = build_scene(copy, options);
  const EmbreeStage theirs(stage, level);
  const auto [hits, differ] = compare(ours, theirs, 1e-5, 2e-3);  // single precision
  CHECK(hits > 1000);
  CHECK(differ <= hits / 200);
  CHECK(theirs.bytes() > 0);
}

TEST_CASE("Embree's subdivision of a scene comes near to the limit", "[tools][bench]") {
  const Stage stage = load_stage({data_file("scenes/mirrors.json"), "catmark", {}});
  Stage copy = stage;
  const Scene ours = build_scene(copy);
  const EmbreeStage theirs(stage, 5, EmbreeSurface::subdivision);
  const auto [hits, differ] = compare(ours, theirs, 1e-3, 0.2);  // facets with edges of 1/32 of a face's
  CHECK(hits > 1000);
  CHECK(differ <= hits / 50);
  CHECK(theirs.bytes() > 0);
}

TEST_CASE("Embree's subdivision refuses what it would draw otherwise", "[tools][bench]") {
  const std::string file = GENERATE("loop_torus.obj", "hole.obj");
  const Stage stage = load_stage({data_file(file), {}, {}});
  CHECK_THROWS_AS(EmbreeStage(stage, 1, EmbreeSurface::subdivision), InputError);
}

}  // namespace shaolin::test
