// The tags that OpenSubdiv accepts, in random combinations, against OpenSubdiv's own surface.
#include "intersect/scene.h"
#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/random.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin {

namespace {

/// The largest distance from OpenSubdiv's surface over random places, in diagonals; half of them crowd to corners.
double worst_difference(const ControlMesh& mesh, const std::string& scheme, std::uint64_t seed) {
  const auto surface = make_limit_surface(mesh, scheme);
  const OpenSubdivOracle oracle(mesh, scheme);
  Random random(seed);
  double worst = 0;
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    SurfaceParameter at{random.index(mesh.face_count()), 0, random.uniform(), random.uniform()};
    at.sub = random.index(surface->sub_count(at.face));
    if (i % 2) at.u *= 1e-3, at.v *= 1e-3;
    if (surface->triangular() && at.u + at.v > 1) at.u = 1 - at.u, at.v = 1 - at.v;
    const auto ours = surface->evaluate(at), theirs = oracle.evaluate(at);
    REQUIRE(ours.has_value() == theirs.has_value());
    if (!ours) continue;
    ++compared;
    worst = std::max(worst, (ours->position - theirs->position).norm() / oracle.diagonal());
  }
  CHECK(compared > 0);
  return worst;
}

/// Sharpness between 0 and 1, where rules change, and between 1 and 4.
float telling_sharpness(Random& random) {
  const auto values = {0.25f, 0.7f, 1.0f, 1.25f, 1.9f, 2.5f, 3.3f, 10.0f};
  return *(values.begin() + random.index(static_cast<int>(values.size())));
}

ControlMesh randomly_tagged(ControlMesh mesh, CreaseMethod method, Random& random) {
  mesh.crease_method = method;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    const auto n = corners.size();
    const auto i = static_cast<std::size_t>(random.index(static_cast<int>(n)));
    if (random.index(2)) mesh.sharp_edges.push_back({corners[i], corners[(i + 1) % n], telling_sharpness(random)});
  }
  if (random.index(2)) mesh.sharp_vertices.push_back({0, telling_sharpness(random)});
  return mesh;
}

/// Triangles, quads and a pentagon around one another, closed.
ControlMesh mixed() {
  ControlMesh mesh = prism(5);
  const std::vector<int> roof(mesh.face(1).begin(), mesh.face(1).end());
  ControlMesh result;
  result.positions = mesh.positions;
  result.positions.emplace_back(0.1, 0.2, 1.7);
  const int top = static_cast<int>(mesh.positions.size());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (f != 1) result.add_face(mesh.face(f));
  for (std::size_t i = 0; i < roof.size(); ++i) result.add_face(std::vector{roof[i], roof[(i + 1) % roof.size()], top});
  return result;
}

}  // namespace

TEST_CASE("Random sharp edges under either decay give OpenSubdiv's surface", "[tools][tags]") {
  for (const CreaseMethod method : {CreaseMethod::uniform, CreaseMethod::chaikin})
    for (const std::string scheme : {"loop", "catmark"})
      for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        const ControlMesh base = seed % 2 ? torus(scheme, 4, 5) : poles(scheme, 3 + static_cast<int>(seed) % 5);
        const ControlMesh mesh = randomly_tagged(shaken(base, 0.2, seed), method, random);
        CAPTURE(scheme, method == CreaseMethod::chaikin, seed);
        // OpenSubdiv sums sharpness in float, in the order of its edges; ours is free of order. An ulp of 6e-8 may part
        // them, of which a blended point keeps a little.
        CHECK(worst_difference(mesh, scheme, seed) < (method == CreaseMethod::chaikin ? 1e-8 : 1e-12));
      }
}

TEST_CASE("No hit is lost where Chaikin's rule takes refinement out of the hull", "[tools][tags]") {
  for (const std::string scheme : {"loop", "catmark"})
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Random random(seed);
      ControlMesh mesh = shaken(torus(scheme, 4, 5), 0.4, seed);
      for (int f = 0; f < mesh.face_count(); ++f)
        if (random.index(2)) mesh.sharp_edges.push_back({mesh.face(f)[0], mesh.face(f)[1], f % 3 ? 1.3f : 0.1f});
      mesh.crease_method = CreaseMethod::chaikin;
      const Scene scene(mesh, scheme);
      const Box bounds = scene.bounds();
      CAPTURE(scheme, seed);
      int lost = 0;
      for (int i = 0; i < 300; ++i) {
        SurfaceParameter at{random.index(mesh.face_count()), 0, random.uniform(0, 0.5), random.uniform(0, 0.5)};
        if (i % 2) at.v = 0;  // on the sharp edges themselves
        const LimitSample target = *scene.surface().evaluate(at);
        REQUIRE((target.position.array() >= bounds.lower.array()).all());
        REQUIRE((target.position.array() <= bounds.upper.array()).all());
        Ray ray;
        ray.direction = random.direction();
        ray.origin = target.position - 20 * ray.direction;
        const auto hit = scene.intersect(ray);
        lost += !hit || hit->t > 20 + 1e-9;
      }
      CHECK(lost == 0);
    }
}

TEST_CASE("Smooth triangles are OpenSubdiv's", "[tools][tags]") {
  ControlMesh mesh = shaken(mixed(), 0.1);
  const auto plain = make_limit_surface(mesh, "catmark");
  mesh.triangle_subdivision = TriangleSubdivision::smooth;
  CHECK(worst_difference(mesh, "catmark", 1) < 1e-13);
  const auto smooth = make_limit_surface(mesh, "catmark");
  const SurfaceParameter roof{mesh.face_count() - 1, 2, 0, 0};
  CHECK((smooth->evaluate(roof)->position - plain->evaluate(roof)->position).norm() > 1e-3);

  Random random(5);
  CHECK(worst_difference(randomly_tagged(mesh, CreaseMethod::chaikin, random), "catmark", 2) < 1e-8);
  ControlMesh open = mesh;  // beside a boundary, and all of triangles
  open.face_offsets.pop_back();
  open.face_vertices.resize(static_cast<std::size_t>(open.face_offsets.back()));
  CHECK(worst_difference(open, "catmark", 3) < 1e-13);
  ControlMesh triangles = shaken(poles("loop", 5), 0.1);
  triangles.triangle_subdivision = TriangleSubdivision::smooth;
  CHECK(worst_difference(triangles, "catmark", 4) < 1e-13);
  CHECK(worst_difference(triangles, "loop", 5) < 1e-13);  // the option is Catmull-Clark's
}

TEST_CASE("The bilinear scheme is OpenSubdiv's, whatever the tags", "[tools][tags]") {
  for (const BoundaryInterpolation boundary :
       {BoundaryInterpolation::none, BoundaryInterpolation::edge_only, BoundaryInterpolation::edge_and_corner}) {
    Random random(7);
    CHECK(worst_difference(with_boundary(shaken(sheet("catmark", 3, 3), 0.3), boundary), "bilinear", 1) < 1e-15);
    CHECK(worst_difference(randomly_tagged(mixed(), CreaseMethod::chaikin, random), "bilinear", 2) < 1e-15);
  }
  ControlMesh mesh = mixed();
  mesh.holes = {2};
  CHECK(!make_limit_surface(mesh, "bilinear")->has_limit(2));
}

}  // namespace shaolin
