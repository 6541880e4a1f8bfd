/// The tool's parts that have numbers of their own: camera, colours, counts.
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/catch.h"
#include "tools/cli/camera.h"
#include "tools/cli/level_map.h"
#include "tools/cli/mesh_counts.h"
#include "tools/cli/png.h"

namespace shaolin::test {
namespace {

ControlMesh make_mesh(int vertices, const std::vector<std::vector<int>>& faces) {
  ControlMesh mesh;
  for (int i = 0; i < vertices; ++i) mesh.positions.emplace_back(i, i * i, 0);
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

/// 3 x 3 quads over 4 x 4 vertices: 12 boundary edges, 12 inner ones.
ControlMesh make_grid() {
  std::vector<std::vector<int>> faces;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) faces.push_back({4 * y + x, 4 * y + x + 1, 4 * y + x + 5, 4 * y + x + 4});
  return make_mesh(16, faces);
}

double luminance(const LinearColor& color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; }

}  // namespace

TEST_CASE("a camera's text parses back to the same camera", "[tools][cli]") {
  const Camera camera = parse_camera("0.1,-2e-3,+3,4,5,6.25,33.3");
  CHECK(camera.eye == Vec3(0.1, -2e-3, 3));
  CHECK(camera.target == Vec3(4, 5, 6.25));
  CHECK(camera.fov == 33.3);
  const Camera again = parse_camera(to_string(camera));
  CHECK(again.eye == camera.eye);
  CHECK(again.target == camera.target);
  CHECK(again.fov == camera.fov);
  CHECK_THROWS_AS(parse_camera(""), std::invalid_argument);
  CHECK_THROWS_AS(parse_camera("1,2,3,4,5,6,40,"), std::invalid_argument);
  CHECK_THROWS_AS(parse_camera("1 ,2,3,4,5,6,40"), std::invalid_argument);
}

TEST_CASE("rays go through the pixels' centres", "[tools][cli]") {
  Camera camera;
  camera.eye = {0, 0, 5};
  camera.fov = 90;
  const View view(camera, {4, 2});
  // The image plane at distance 1 spans [-2, 2] x [-1, 1] in pixels of side 1.
  CHECK((view.ray(0, 0).direction - Vec3(-1.5, 0.5, -1).normalized()).norm() < 1e-15);
  CHECK((view.ray(3, 1).direction - Vec3(1.5, -0.5, -1).normalized()).norm() < 1e-15);
  CHECK(view.ray(2, 1).origin == camera.eye);
}

TEST_CASE("a camera that looks along y has an upright image all the same", "[tools][cli]") {
  for (const double side : {1.0, -1.0}) {
    Camera camera;
    camera.eye = {0, 7 * side, 0};
    const View view(camera, {100, 100});
    CHECK(view.right().isApprox(Vec3::UnitX()));
    CHECK(view.up().isApprox(-side * Vec3::UnitZ()));
    CHECK(view.ray(3, 4).direction.norm() == Approx(1));
  }
}

TEST_CASE("the default camera's image just holds the bounding sphere", "[tools][cli]") {
  const Box box{{-1, 2, -3}, {2, 4, 0}};
  const double radius = 0.5 * std::sqrt(9 + 4 + 9);
  for (const ImageSize size : {ImageSize{300, 200}, ImageSize{200, 200}, ImageSize{100, 400}}) {
    const Camera camera = default_camera(box, size);
    CHECK(camera.target == Vec3(0.5, 3, -1.5));
    const double sphere_angle = std::asin(radius / (camera.eye - camera.target).norm());
    const double up_angle = camera.fov / 2 * std::numbers::pi / 180;
    const double side_angle = std::atan(std::tan(up_angle) * size.aspect());
    CHECK(sphere_angle == Approx(std::min(up_angle, side_angle)));
  }
}

TEST_CASE("sRGB encoding", "[tools][cli]") {
  CHECK(srgb_from_linear({0, 1, 0.5}) == SrgbColor{0, 255, 188});
  CHECK(srgb_from_linear({-1, 2, 0.002}) == SrgbColor{0, 255, 7});
  CHECK(srgb_from_linear({0.18, 0.0031308, 0.0031309}) == SrgbColor{118, 10, 10});
}

TEST_CASE("deeper levels look lighter", "[tools][cli]") {
  for (const int deepest : {1, 4, 12}) {
    for (int level = 1; level <= deepest; ++level)
      CHECK(luminance(level_color(level, deepest)) > luminance(level_color(level - 1, deepest)));
  }
}

TEST_CASE("the level map counts the pixels of each level", "[tools][cli]") {
  const ImageSize size{40, 30};
  Image image(size);
  for (int x = 0; x < 10; ++x) {
    image.at(x, 5).face = 0;
    image.at(x, 5).level = static_cast<std::uint32_t>(x / 5);
    image.at(x, 5).normal = {0, 0, 1};
  }
  Picture picture = level_map(image, View(Camera{}, size));
  CHECK((picture.width > 40 && picture.height >= 30));
  CHECK(picture.at(0, 5) != picture.at(9, 5));   // two levels
  CHECK(picture.at(20, 5) == picture.at(0, 0));  // the background
}

TEST_CASE("counts of a grid", "[tools][cli]") {
  ControlMesh mesh = make_grid();
  MeshCounts counts = count(mesh, 4);
  CHECK((counts.vertices == 16 && counts.edges == 24 && counts.faces == 9));
  CHECK(counts.faces_by_size == std::map<int, std::size_t>{{4, 9}});
  CHECK(counts.vertices_by_valence == std::map<int, std::size_t>{{2, 4}, {3, 8}, {4, 4}});
  CHECK((counts.boundary_edges == 12 && counts.boundary_vertices == 12 && counts.non_manifold_edges == 0));
  CHECK((counts.smooth == 4 && counts.dart == 0 && counts.crease == 8 && counts.corner == 4));
  CHECK(counts.extraordinary == 4);  // the four corners

  mesh.boundary = BoundaryInterpolation::edge_only;
  CHECK(count(mesh, 4).corner == 0);

  mesh.sharp_edges = {{6, 5, 2.5f}, {9, 10, 10.0f}, {0, 15, 3.0f}};  // the third does not exist
  mesh.sharp_vertices = {{5, 1.0f}};
  mesh.holes = {4, 4};
  counts = count(mesh, 4);
  CHECK((counts.semi_sharp_creases == 1 && counts.infinite_creases == 1));
  CHECK((counts.semi_sharp_corners == 1 && counts.infinite_corners == 0));
  CHECK((counts.smooth == 0 && counts.dart == 3 && counts.corner == 1 && counts.crease == 12));
  CHECK(counts.holes == 1);
}

TEST_CASE("counts of odd meshes", "[tools][cli]") {
  // Three triangles at one edge, and a vertex that nothing uses.
  const MeshCounts fan = count(make_mesh(6, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), 6);
  CHECK((fan.edges == 7 && fan.non_manifold_edges == 1 && fan.boundary_edges == 6));
  CHECK((fan.isolated_vertices == 1 && fan.corner == 5));
  CHECK(fan.vertices_by_valence == std::map<int, std::size_t>{{0, 1}, {2, 3}, {4, 2}});

  // A quad that repeats a vertex has no edge from the vertex to itself.
  CHECK(count(make_mesh(3, {{0, 1, 1, 2}}), 4).edges == 3);
}

}  // namespace shaolin::test
