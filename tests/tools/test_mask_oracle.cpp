// The oracle of plain refinement, held against OpenSubdiv where both know the scheme, and what it finds.
#include "tools/validate/mask_oracle.h"

#include "intersect/scene.h"
#include "schemes/builtin.h"
#include "tests/catch.h"
#include "tests/tools/oracle_models.h"
#include "tools/validate/agreement.h"
#include "tools/validate/check_evaluations.h"
#include "tools/validate/check_rays.h"

namespace shaolin::oracle_test {
namespace {

TEST_CASE("Plain refinement by the masks gives OpenSubdiv's surface", "[tools][oracle]") {
  for (const Model& model : feature_models()) {
    CAPTURE(model.name);
    const OpenSubdivOracle expected(model.mesh, model.scheme);
    const MaskOracle oracle(model.mesh, builtin_masks(model.scheme));
    std::mt19937 random(5);
    int normals = 0;
    for (int i = 0; i < 12; ++i) {
      const SurfaceParameter at = random_parameter(oracle, random);
      const auto theirs = expected.evaluate(at), ours = oracle.evaluate(at);
      REQUIRE(ours.has_value() == theirs.has_value());
      if (!ours) continue;
      CAPTURE(exact(at));
      CHECK((ours->position - theirs->position).norm() <= 1e-13 * oracle.diagonal());
      if (ours->normal.isZero()) continue;
      ++normals;
      CHECK(angle_between_units(ours->normal, theirs->normal) <= bar::normal);
    }
    CHECK(normals > 6);
  }
}

/// OpenSubdiv has none. Cones stay cones on the way, also where a mesh is refined once as a whole, and creases and
/// darts win over them.
TEST_CASE("Plain refinement knows conical vertices", "[tools][oracle][sweep]") {
  for (Model& model : feature_models()) {
    model.mesh.cones = {0, 3};
    CAPTURE(model.name);
    const MaskOracle oracle(model.mesh, builtin_masks(model.scheme));
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    CHECK(check_evaluations(Evaluator::of(*surface), oracle, sample_parameters(oracle, 16, 3)).passed());
  }
  ControlMesh mesh = shaken(cube(), 0.13);
  const auto smooth = make_limit_surface(mesh, "catmark");
  mesh.cones = {0};
  const MaskOracle oracle(mesh, builtin_masks("catmark"));
  CHECK_FALSE(check_evaluations(Evaluator::of(*smooth), oracle, sample_parameters(oracle, 16, 3)).passed());
  CHECK_THROWS_AS(OpenSubdivOracle(mesh, "catmark"), InputError);
}

TEST_CASE("Without a dense check, rays that were aimed find what is lost", "[tools][oracle]") {
  const ControlMesh mesh = shaken(cube(), 0.13);
  const auto masks = builtin_masks("catmark");
  const MaskOracle oracle(mesh, masks);
  const Scene scene(mesh, masks);
  const auto rays = sample_rays(oracle, 30, 7);
  CHECK(check_rays(Intersector::of(scene), oracle, nullptr, rays).passed());
  const Intersector blind{[](const Ray&) { return std::optional<Hit>(); }, [](const Ray&) { return false; }};
  const RayFigures figures = check_rays(blind, oracle, nullptr, rays).total();
  CHECK(figures.lost >= 5);  // of 13 with a target, 10 of them grazing
  CHECK(figures.lost + figures.undecided == 13);
}

/// Semi-sharp shares in float and a seam around two glued triangles are what it found.
TEST_CASE("Plain refinement agrees with schemes that OpenSubdiv does not have", "[tools][oracle]") {
  for (const std::string name : {"warren", "linear"}) {
    const ControlMesh mesh = with_edges(shaken(poles("loop", 5), 0.13), {{0, 2, 2.3f}, {2, 3, 10}});
    const MaskOracle oracle(mesh, builtin_masks(name));
    const auto surface = make_limit_surface(mesh, name);
    CAPTURE(name);
    CHECK(check_evaluations(Evaluator::of(*surface), oracle, sample_parameters(oracle, 40, 3)).passed());
  }
}

}  // namespace
}  // namespace shaolin::oracle_test
