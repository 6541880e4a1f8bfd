// The closed form beside a semi-sharp crease against the limit by repeated splitting, which shares none of its algebra.
#include "schemes/crease_strips.h"

#include "schemes/catmull_clark.h"
#include "schemes/evaluate.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/random.h"

namespace shaolin {

namespace {

constexpr int strip_cells = 5;
int vertex(int column, int row) { return row * (strip_cells + 1) + column; }
constexpr int middle_face = 2 * strip_cells + 2;

/// A shaken sheet with a crease along one of the middle face's four sides, from rim to rim.
ControlMesh creased(int side, float sharpness) {
  ControlMesh mesh = shaken(sheet("catmark", strip_cells, strip_cells), 0.3);
  const int line = side == 0 || side == 3 ? 2 : 3;
  for (int i = 0; i < strip_cells; ++i) {
    if (side % 2 == 0)
      mesh.sharp_edges.push_back({vertex(i, line), vertex(i + 1, line), sharpness});
    else
      mesh.sharp_edges.push_back({vertex(line, i), vertex(line, i + 1), sharpness});
  }
  return mesh;
}

std::optional<CreaseStrips> strips_of_middle(const ControlMesh& mesh) {
  const SubdivisionMesh<CatmullClark> refined(mesh);
  return refined.patch({middle_face, 0}).configuration->crease_strips();
}

BezierQuad polynomial_of(const CreaseStrips::Strip& strip, const std::array<Vec3, 16>& grid) {
  BezierQuad polynomial;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    Eigen::Matrix4d points;
    for (Eigen::Index i = 0; i < 16; ++i) points(i / 4, i % 4) = grid[static_cast<std::size_t>(i)][axis];
    const Eigen::Matrix4d bezier = strip.maps.v.matrix * points * strip.maps.u.matrix.transpose();
    for (Eigen::Index i = 0; i < 16; ++i) polynomial.b[static_cast<std::size_t>(i)][axis] = bezier(i / 4, i % 4);
  }
  return polynomial;
}

}  // namespace

TEST_CASE("Strips beside a semi-sharp crease are the limit", "[schemes][crease_strips]") {
  for (const float sharpness : {0.1F, 0.75F, 1.0F, 1.5F, 2.0F, 3.5F, 6.0F, 9.99F})
    for (const int side : {0, 1, 2, 3}) {
      CAPTURE(sharpness, side);
      const SubdivisionMesh<CatmullClark> mesh(creased(side, sharpness));
      const Patch<CatmullClark> patch = mesh.patch({middle_face, 0});
      const auto& strips = patch.configuration->crease_strips();
      REQUIRE(strips);
      const std::vector<CreaseStrips::Strip>& all = strips->strips();
      CHECK(all.size() == static_cast<std::size_t>(std::ceil(sharpness)) + 1);
      Random random(5);
      double area = 0, worst_position = 0, worst_derivative = 0;
      for (const CreaseStrips::Strip& strip : all) {
        const SubDomain& domain = strip.domain;
        const BezierQuad polynomial = polynomial_of(strip, strips->grid(patch.points.data()));
        area += domain.scale.prod();
        for (int i = 0; i < 20; ++i) {
          const Parameter at(random.uniform(0.01, 0.99), random.uniform(0.01, 0.99));
          const LimitSample limit = evaluate(patch, domain(at));
          worst_position = std::max(worst_position, (polynomial.position(at) - limit.position).norm());
          REQUIRE(limit.derivatives);
          const Derivatives d = polynomial.derivatives(at);
          worst_derivative = std::max({worst_derivative, (d.du / domain.scale.x() - limit.derivatives->du).norm(),
                                       (d.dv / domain.scale.y() - limit.derivatives->dv).norm()});
        }
      }
      CHECK(area == 1);
      CHECK(worst_position <= 1e-14);
      CHECK(worst_derivative <= 2e-11);  // strips are 2^-10 wide at the least: roundings of 1e-14 over that
    }
}

TEST_CASE("Strips lie side by side, from the far side to the crease", "[schemes][crease_strips]") {
  for (const int side : {0, 1, 2, 3}) {
    CAPTURE(side);
    const SubdivisionMesh<CatmullClark> mesh(creased(side, 3));
    const Patch<CatmullClark> patch = mesh.patch({middle_face, 0});
    const Eigen::Index across = side % 2 == 0 ? 1 : 0;
    double from = 1;  // the distance from the crease that the strips so far have come to
    const std::vector<CreaseStrips::Strip>& all = patch.configuration->crease_strips()->strips();
    REQUIRE(all.size() == 4);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const SubDomain& domain = all[i].domain;
      const double width = i < 3 ? from / 2 : from;
      CHECK(domain.scale[across] == width);
      CHECK(domain.scale[1 - across] == 1);
      CHECK(domain.origin[across] == (side == 0 || side == 3 ? from - width : 1 - from));
      from -= width;
    }
    CHECK(from == 0);
  }
}

TEST_CASE("There are strips only where refinement is a tensor product", "[schemes][crease_strips]") {
  const ControlMesh plain = creased(0, 2);
  REQUIRE(strips_of_middle(plain));
  SECTION("not on a smooth face") { CHECK(!strips_of_middle(creased(0, 0))); }
  SECTION("not beside an infinitely sharp edge") { CHECK(!strips_of_middle(creased(0, 10))); }
  SECTION("not where the sharpness changes") {
    ControlMesh mesh = plain;
    mesh.sharp_edges[3].sharpness = 3;
    CHECK(!strips_of_middle(mesh));
  }
  SECTION("not at the crease's end") {
    ControlMesh mesh = plain;
    mesh.sharp_edges.resize(3);
    CHECK(!strips_of_middle(mesh));
  }
  SECTION("not where two creases cross or run side by side") {
    for (const int other : {1, 2, 3}) {
      ControlMesh mesh = plain;
      for (const SharpEdge& edge : creased(other, 2).sharp_edges) mesh.sharp_edges.push_back(edge);
      CHECK(!strips_of_middle(mesh));
    }
  }
  SECTION("not at a sharp vertex") {
    for (const int v : {vertex(2, 2), vertex(3, 3)}) {
      ControlMesh mesh = plain;
      mesh.sharp_vertices.push_back({v, 1});
      CHECK(!strips_of_middle(mesh));
    }
  }
  SECTION("not under Chaikin's rule, where neighbours have a say in the sharpness") {
    ControlMesh mesh = plain;
    mesh.crease_method = CreaseMethod::chaikin;
    CHECK(!strips_of_middle(mesh));
  }
  SECTION("not at an extraordinary vertex") {
    ControlMesh mesh = poles("catmark", 5);
    for (int i = 0; i < 10; ++i) mesh.sharp_edges.push_back({2 + i, 2 + (i + 1) % 10, 2});
    const SubdivisionMesh<CatmullClark> refined(mesh);
    for (const int face : refined.faces()) CHECK(!refined.patch({face, 0}).configuration->crease_strips());
  }
}

}  // namespace shaolin
