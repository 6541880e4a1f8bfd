// The uniform tessellation: its corners are on the limit, its rays come closer to the exact ones level by level.
#include "intersect/tessellation.h"
#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/intersect/method_models.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

SceneOptions uniform(int level) { return {Method::uniform, level, {}}; }

/// Relative to the model's size: how far along the ray hits of a tessellation are from the exact ones.
double median_error(const Model& model, int level) {
  const Scene exact(model.mesh, model.scheme), facets(model.mesh, model.scheme, uniform(level));
  const double size = (exact.bounds().upper - exact.bounds().lower).norm();
  std::vector<double> errors;
  for (const Ray& ray : random_rays(exact.bounds(), 400, 51)) {
    const auto a = exact.intersect(ray), b = facets.intersect(ray);
    if (a && b) errors.push_back((a->sample.position - b->sample.position).norm() / size);
  }
  REQUIRE(errors.size() > 50);
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

}  // namespace

TEST_CASE("Facets' corners are the limit at their parameters", "[intersect][uniform]") {
  for (const Model& model : method_models()) {
    CAPTURE(model.name, model.scheme);
    with_scheme(model.scheme, [&](const auto& scheme) {
      using S = std::decay_t<decltype(scheme)>;
      using D = Domain<S::face_kind>;
      const SchemeSurface<S> surface(model.mesh, scheme);
      for (const int level : {1, 3}) {
        const auto tessellation = tessellate(surface.mesh(), level);
        std::size_t expected = 0;
        for (const int f : surface.mesh().faces())
          if (surface.has_limit(f))
            expected += static_cast<std::size_t>(surface.sub_count(f)) << 2 * (level - surface.splits_by_corner(f));
        REQUIRE(tessellation.facets.size() == expected);
        for (const auto& facet : tessellation.facets) {
          for (std::size_t k = 0; k < facet.corners.size(); ++k) {
            const Parameter at = facet.origin + facet.scale * Parameter(D::corners[k][0], D::corners[k][1]);
            const auto limit = surface.evaluate({facet.face, facet.sub, at.x(), at.y()});
            REQUIRE(limit);
            const Vec3& corner = tessellation.points[static_cast<std::size_t>(facet.corners[k])];
            REQUIRE((corner - limit->position).norm() < 1e-13);
            REQUIRE((facet.normals[k] - limit->normal).norm() < 1e-7);
          }
        }
      }
    });
  }
}

TEST_CASE("Errors of a tessellation fall with the square of the facets' size", "[intersect][uniform]") {
  for (const Model& model : method_models()) {
    CAPTURE(model.name, model.scheme);
    const double coarse = median_error(model, 3), fine = median_error(model, 4);
    CHECK(coarse < 5e-3);
    CHECK(coarse / fine > 3);
    CHECK(coarse / fine < 5);
  }
}

TEST_CASE("A hit names its place: the limit there is as near as the facet is", "[intersect][uniform]") {
  for (const Model& model : method_models()) {
    CAPTURE(model.name, model.scheme);
    const Scene scene(model.mesh, model.scheme, uniform(4));
    const double size = (scene.bounds().upper - scene.bounds().lower).norm();
    int hits = 0;
    for (const Ray& ray : random_rays(scene.bounds(), 200, 52)) {
      const auto hit = scene.intersect(ray);
      REQUIRE(scene.occluded(ray) == hit.has_value());
      if (!hit) continue;
      ++hits;
      CHECK((hit->sample.position - (ray.origin + hit->t * ray.direction)).norm() < 1e-13 * size);
      const auto limit = scene.surface().evaluate(hit->at);
      REQUIRE(limit);
      CHECK((limit->position - hit->sample.position).norm() < 5e-3 * size);
      CHECK(hit->sample.normal.norm() == Approx(1).epsilon(1e-14));
      CHECK(hit->level == 4);
      CHECK(!hit->sample.derivatives);
    }
    CHECK(hits > 30);
  }
}

TEST_CASE("From inside a closed tessellation every ray hits, through corners and sides too", "[intersect][uniform]") {
  const ControlMesh mesh = poles("catmark", 9);
  const Scene scene(mesh, "catmark", uniform(3));
  const SchemeSurface<CatmullClark> surface(mesh);
  const auto tessellation = tessellate(surface.mesh(), 3);
  const Vec3 centre = scene.bounds().centre();
  for (const auto& facet : tessellation.facets) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& a = tessellation.points[static_cast<std::size_t>(facet.corners[k])];
      const Vec3& b = tessellation.points[static_cast<std::size_t>(facet.corners[(k + 1) % 4])];
      const Vec3& c = tessellation.points[static_cast<std::size_t>(facet.corners[(k + 2) % 4])];
      for (const Vec3& target : {a, Vec3(0.5 * (a + b)), Vec3(0.5 * (a + c))})
        CHECK(scene.intersect({centre, target - centre, 0, std::numeric_limits<double>::infinity()}));
    }
  }
}

TEST_CASE("Nothing is tessellated before a ray meets the object's box", "[intersect][uniform]") {
  const Scene scene(poles("loop", 5), "loop", uniform(4));
  const Vec3 outside = scene.bounds().upper + Vec3(1, 1, 1);
  CHECK(!scene.intersect({outside, Vec3::UnitX()}));
  CHECK(scene.statistics().bytes == 0);
  CHECK(scene.statistics().faces_touched == 0);
  scene.intersect({outside, scene.bounds().centre() - outside});
  const Statistics work = scene.statistics();
  CHECK(work.faces == 10);
  CHECK(work.faces_touched == 10);
  CHECK(work.bytes > 2560 * sizeof(Facet<FaceKind::triangle>));
  CHECK(work.cells > 0);
}

TEST_CASE("A level out of range is an error, and so is what cannot be refined", "[intersect][uniform]") {
  for (const int level : {-1, 0, 11}) CHECK_THROWS_AS(Scene(cube(), "catmark", uniform(level)), InputError);
  // Triangles beside a vertex of valence 2 have two edges between the same vertices after a step.
  const Scene scene(pillow(), "loop", uniform(2));
  CHECK_THROWS_AS(scene.intersect({{0.4, 0.3, 5}, {0, 0, -1}}), InputError);
}

TEST_CASE("A mesh without a limit is missed", "[intersect][uniform]") {
  ControlMesh mesh = tetrahedron();
  mesh.holes = {0, 1, 2, 3};
  const Scene scene(mesh, "loop", uniform(2));
  CHECK(!scene.intersect({{0, 0, 5}, {0, 0, -1}}));
}

}  // namespace shaolin
