// Sharpness between smooth and infinite, and what the boundary does.
#include <cmath>
#include <limits>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// A sheet with a bump and a crease of one sharpness over its middle row: vertices 10 to 14 of 5 x 5.
ControlMesh ridge(const std::string& scheme, float sharpness) {
  ControlMesh mesh = sheet(scheme, 4, 4);
  for (int i = 10; i < 15; ++i) mesh.positions[static_cast<std::size_t>(i)].z() = 1;
  for (int i = 10; i < 14 && sharpness > 0; ++i) mesh.sharp_edges.push_back({i, i + 1, sharpness});
  return mesh;
}

/// Of vertex 12, the sheet's middle, in the first face that it is a corner of.
double middle_height(const ControlMesh& mesh, const std::string& scheme) {
  const auto surface = make_limit_surface(mesh, scheme);
  return surface->evaluate({scheme == "catmark" ? 10 : 20, 0, 0, 0})->position.z();
}

/// The input that refine() would have: the refined mesh with its tags.
template <Scheme S>
ControlMesh refined(const ControlMesh& mesh) {
  const SubdivisionMesh<S> coarse(mesh);
  const auto fine = coarse.refine();
  ControlMesh result;
  result.positions = fine->points();
  for (const int f : fine->faces()) result.add_face(fine->face(f));
  for (const SharpEdge& tag : mesh.sharp_edges)
    for (const int e : coarse.edges()) {
      const Mesh::Edge edge = coarse.edge(e);
      if (std::minmax(edge.a, edge.b) != std::minmax(tag.a, tag.b)) continue;
      const float left = tag.sharpness >= 10 ? 10 : std::max(0.0f, tag.sharpness - 1);
      result.sharp_edges.push_back({edge.a, coarse.child_of_edge(e), left});
      result.sharp_edges.push_back({coarse.child_of_edge(e), edge.b, left});
    }
  for (const SharpVertex& tag : mesh.sharp_vertices)
    result.sharp_vertices.push_back({tag.vertex, std::max(0.0f, tag.sharpness - 1)});
  return result;
}

int faces_with_limit(const LimitSurface& surface) {
  int count = 0;
  for (int f = 0; f < surface.face_count(); ++f) count += surface.has_limit(f);
  return count;
}

}  // namespace

TEMPLATE_TEST_CASE("The sharper a ridge, the higher: from the smooth surface up to the crease", "[schemes][semi_sharp]",
                   Loop, CatmullClark) {
  const std::string scheme = TestType::name;
  // On a ridge straight along x the crease's own spline keeps z = 1. Across, the smooth surface is the cubic B-spline
  // (Loop's restricted to it as well: the sheet's points depend on one direction only), 2/3 of the peak.
  CHECK(middle_height(ridge(scheme, 0), scheme) == Approx(2.0 / 3).epsilon(1e-15));
  CHECK(middle_height(ridge(scheme, 10), scheme) == 1);
  double last = 2.0 / 3;
  for (int k = 1; k < 40; ++k) {
    const float sharpness = 0.25f * static_cast<float>(k);
    const double height = middle_height(ridge(scheme, sharpness), scheme);
    CAPTURE(sharpness, height);
    CHECK(height > last);
    CHECK(height < 1);
    last = height;
  }
}

TEMPLATE_TEST_CASE("Each whole step of sharpness halves what a ridge lacks", "[schemes][semi_sharp]", Loop,
                   CatmullClark) {
  // While the crease rule holds, the crease stays at 1 and its neighbour rows approach it by half of the distance a
  // level (the tent's values at 1/2^s): then the smooth limit takes 2/3 of the crease and 1/6 of each neighbour.
  const std::string scheme = TestType::name;
  double expected = 1.0 / 3;
  for (int s = 0; s < 10; ++s, expected /= 2) {
    const double lack = 1 - middle_height(ridge(scheme, static_cast<float>(s)), scheme);
    CAPTURE(s);
    CHECK(lack == Approx(expected).epsilon(1e-12));
  }
}

TEMPLATE_TEST_CASE("Sharpness 10 and more is one crease; just below it differs by a thousandth",
                   "[schemes][semi_sharp]", Loop, CatmullClark) {
  const std::string scheme = TestType::name;
  for (const float sharpness : {10.0f, 10.01f, 1e6f, std::numeric_limits<float>::infinity()})
    CHECK(middle_height(ridge(scheme, sharpness), scheme) == 1);
  // Nine whole steps, then a share of 0.99 of the crease rule, and a last smooth one.
  const double lack = 1 - middle_height(ridge(scheme, 9.99f), scheme);
  CHECK(lack > std::ldexp(1.0, -10) / 3);
  CHECK(lack < std::ldexp(1.0, -9) / 3);
}

TEMPLATE_TEST_CASE("A surface is that of its refined mesh with sharpness less one", "[schemes][semi_sharp]", Loop,
                   CatmullClark) {
  using S = TestType;
  using D = Domain<S::face_kind>;
  for (const float sharpness : {0.0f, 0.4f, 1.0f, 1.6f, 3.0f, 4.7f, 9.99f, 10.0f}) {
    ControlMesh mesh = shaken(poles(S::name, 5), 0.2);
    const std::vector<int> v(mesh.face(0).begin(), mesh.face(0).end());
    mesh.sharp_edges = {{v[0], v[1], sharpness}, {v[1], v[2], 2.5f}};
    mesh.sharp_vertices = {{1, 1.3f}, {v[2], 2.75f}};
    const SubdivisionMesh<S> topology(mesh);
    const SchemeSurface<S> coarse(mesh), fine(refined<S>(mesh));
    for (const int f : topology.faces())
      for (int k = 0; k < topology.child_count(f); ++k)
        for (const auto& [x, y] : {std::array{0.0, 0.0}, std::array{0.25, 0.5}, std::array{1.0, 0.0}}) {
          const Parameter at = D::to_parent(k, {x, y});
          const LimitSample a = *coarse.evaluate({f, 0, at.x(), at.y()});
          const LimitSample b = *fine.evaluate({topology.child_face(f, k), 0, x, y});
          CAPTURE(sharpness, f, k, x, y);
          CHECK((a.position - b.position).norm() < 1e-14 * mesh.diagonal());
          CHECK((a.normal - b.normal).norm() < 1e-9);
        }
  }
}

TEMPLATE_TEST_CASE("Without interpolation only faces off the boundary have a limit", "[schemes][boundary]", Loop,
                   CatmullClark) {
  ControlMesh mesh = sheet(TestType::name, 5, 4);
  mesh.boundary = BoundaryInterpolation::none;
  const auto surface = make_limit_surface(mesh, TestType::name);
  const int per_cell = TestType::face_kind == FaceKind::quad ? 1 : 2;
  CHECK(faces_with_limit(*surface) == 3 * 2 * per_cell);
  for (int f = 0; f < surface->face_count(); ++f) {
    const int i = f / per_cell % 5, j = f / per_cell / 5;
    CAPTURE(f);
    CHECK(surface->has_limit(f) == (i >= 1 && i <= 3 && j >= 1 && j <= 2));
    CHECK(surface->evaluate({f, 0, 0.25, 0.25}).has_value() == surface->has_limit(f));
  }
  // On a regular flat sheet the surface has linear precision: vertex (2, 2) is its own limit.
  const LimitSample inner = *surface->evaluate({12 * per_cell, 0, 0, 0});
  CHECK((inner.position - Vec3(2, 2, 0)).norm() < 1e-15);
}

TEMPLATE_TEST_CASE("An interpolated boundary is a spline that ends in the corners or rounds them",
                   "[schemes][boundary]", Loop, CatmullClark) {
  ControlMesh mesh = sheet(TestType::name, 3, 3);
  // Corner (3, 0) has one face in both schemes: face 2 at place 1, or triangle 4 at place 1.
  const int face = TestType::face_kind == FaceKind::quad ? 2 : 4;
  const auto corner = [&] { return make_limit_surface(mesh, TestType::name)->evaluate({face, 0, 1, 0})->position; };
  CHECK(faces_with_limit(*make_limit_surface(mesh, TestType::name)) == mesh.face_count());
  CHECK(corner() == Vec3(3, 0, 0));
  mesh.boundary = BoundaryInterpolation::edge_only;
  CHECK(faces_with_limit(*make_limit_surface(mesh, TestType::name)) == mesh.face_count());
  // 2/3 of the corner and 1/6 of its neighbours on the boundary, (2, 0) and (3, 1).
  CHECK((corner() - Vec3(3 - 1.0 / 6, 1.0 / 6, 0)).norm() < 1e-15);
  mesh.sharp_vertices = {{3, 10}};
  CHECK(corner() == Vec3(3, 0, 0));
}

TEMPLATE_TEST_CASE("A hole shapes its neighbours as if it were there", "[schemes][hole]", Loop, CatmullClark) {
  ControlMesh mesh = shaken(poles(TestType::name, 5), 0.2);
  const auto whole = make_limit_surface(mesh, TestType::name);
  mesh.holes = {3};
  const auto holed = make_limit_surface(mesh, TestType::name);
  for (int f = 0; f < mesh.face_count(); ++f)
    for (const auto& [u, v] : {std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{0.3, 0.45}}) {
      const std::optional<LimitSample> sample = holed->evaluate({f, 0, u, v});
      CAPTURE(f, u, v);
      REQUIRE(sample.has_value() == (f != 3));
      if (!sample) continue;
      CHECK(sample->position == whole->evaluate({f, 0, u, v})->position);
      CHECK(sample->normal == whole->evaluate({f, 0, u, v})->normal);
    }
}

}  // namespace shaolin
