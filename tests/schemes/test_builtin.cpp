// The built-in schemes by name; those that stay on their control mesh; Warren's weights.
#include "schemes/builtin.h"

#include "intersect/scene.h"
#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

TEST_CASE("Every built-in scheme makes a surface under its name", "[schemes][builtin]") {
  CHECK(builtin_scheme_names() == "loop, catmark, warren, linear or bilinear");
  for (const BuiltinScheme& scheme : builtin_schemes()) {
    CAPTURE(scheme.name);
    const bool triangles = scheme.face_kind == FaceKind::triangle;
    const auto surface = make_limit_surface(poles(triangles ? "loop" : "catmark", 5), scheme.name);
    CHECK(surface->triangular() == triangles);
    const auto sample = surface->evaluate({0, 0, 0.25, 0.25});
    CHECK(sample->normal.norm() == Approx(1));
    CHECK(sample->derivatives);
  }
  CHECK_THROWS_WITH(make_limit_surface(cube(), "doo-sabin"),
                    Catch::Contains("'doo-sabin'") && Catch::Contains("loop, catmark"));
}

TEST_CASE("The linear scheme's surface is the triangles", "[schemes][builtin]") {
  const ControlMesh mesh = shaken(poles("loop", 7), 0.2);
  const auto surface = make_limit_surface(mesh, "linear");
  const Scene scene(mesh, "linear");
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const int f = random.index(mesh.face_count());
    const auto corner = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(mesh.face(f)[k])]; };
    const double u = random.uniform(), v = (1 - u) * random.uniform();
    const Vec3 expected = corner(0) + u * (corner(1) - corner(0)) + v * (corner(2) - corner(0));
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const auto sample = surface->evaluate({f, 0, u, v});
    CHECK((sample->position - expected).norm() < 1e-14);
    CHECK((sample->normal - normal).norm() < 1e-13);
    CHECK(sample->derivatives->duu.norm() < 1e-13);
    const auto at_corner = surface->evaluate({f, 0, 0, 0});
    CHECK((at_corner->position - corner(0)).norm() < 1e-15);
    CHECK((at_corner->normal - normal).norm() < 1e-13);
    Ray ray;
    ray.origin = expected + normal;
    ray.direction = -normal;
    ray.tmax = 1.5;
    const auto hit = scene.intersect(ray);
    REQUIRE(hit);
    CHECK(hit->t <= 1 + 1e-13);
    if (hit->at.face == f) CHECK((hit->sample.position - expected).norm() < 1e-13);
  }
}

TEST_CASE("Warren's weights are Loop's at valence 3 and 6 and give another surface at the rest", "[schemes][builtin]") {
  CHECK(Warren::smooth_vertex(3).edge == 3.0 / 16);
  CHECK(Warren::smooth_vertex(6).edge == 1.0 / 16);
  CHECK(Warren::smooth_vertex(5).edge == Approx(3.0 / 40).epsilon(1e-15));
  const auto at_pole = [](int n, const char* scheme) {
    return make_limit_surface(poles("loop", n), scheme)->evaluate({0, 0, 0, 0})->position.z();
  };
  // A pole at height 1 over a flat rim keeps the limit mask's weight of the vertex: 1 - n / (n + 3 / (8 beta)).
  for (const int n : {3, 4, 5, 7, 12}) {
    const double beta = n == 3 ? 3.0 / 16 : 3.0 / (8.0 * n);
    CHECK(at_pole(n, "warren") == Approx(1 - n / (n + 3 / (8 * beta))).epsilon(1e-14));
  }
  CHECK(at_pole(3, "warren") == Approx(at_pole(3, "loop")).epsilon(1e-14));
  CHECK(std::abs(at_pole(4, "warren") - at_pole(4, "loop")) > 1e-3);
}

}  // namespace shaolin
