// Cutting into manifold pieces: how often, where, and with which sharpness.
#include "schemes/manifold.h"

#include <algorithm>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/subdivision_mesh.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// Topology alone matters here: points on a parabola, no three in line.
ControlMesh faces_only(const std::vector<std::vector<int>>& faces) {
  int most = 0;
  for (const auto& face : faces) most = std::max(most, *std::max_element(face.begin(), face.end()));
  std::vector<Vec3> points;
  for (int i = 0; i <= most; ++i) points.emplace_back(i, i * i, 0);
  return mesh_of(points, faces);
}

ManifoldMesh cut_of(const ControlMesh& mesh) { return cut_to_manifold(std::make_shared<const ControlMesh>(mesh)); }

const std::vector<int>& vertices_of(const ManifoldMesh& cut) { return cut.half_edges.mesh().face_vertices; }

/// The number of cut vertices that each input vertex became.
std::vector<int> pieces(const ControlMesh& input, const ManifoldMesh& cut) {
  std::vector<int> result(input.positions.size(), 0);
  for (const int origin : cut.origin) ++result[static_cast<std::size_t>(origin)];
  return result;
}

/// Faces keep their numbers and corners, and all fit into half-edges.
template <Scheme S>
void check_holds(const ControlMesh& input) {
  const ManifoldMesh cut = cut_of(input);
  REQUIRE(cut.half_edges.mesh().face_offsets == input.face_offsets);
  CHECK(cut.half_edges.misfit() == -1);
  for (std::size_t i = 0; i < input.face_vertices.size(); ++i)
    CHECK(cut.origin[static_cast<std::size_t>(vertices_of(cut)[i])] == input.face_vertices[i]);
  const SubdivisionMesh<S> mesh(input);
  for (const int v : mesh.vertices())
    if (mesh.corner_at(v).face >= 0) CHECK_FALSE(mesh.ring(mesh.corner_at(v)).faces.empty());
}

constexpr float infinite = infinite_sharpness;

}  // namespace

TEMPLATE_TEST_CASE("A manifold mesh stays whole", "[schemes][manifold]", Loop, CatmullClark) {
  for (const ControlMesh& mesh : {poles(TestType::name, 5), sheet(TestType::name, 3, 2), torus(TestType::name, 4, 4)}) {
    const ManifoldMesh cut = cut_of(mesh);
    CHECK(cut.cut_edges == 0);
    CHECK(cut.cut_vertices == 0);
    CHECK(cut.half_edges.is_manifold());
    CHECK(cut.origin.size() == mesh.positions.size());
    CHECK(vertices_of(cut) == mesh.face_vertices);
    check_holds<TestType>(mesh);
  }
}

TEST_CASE("Three faces at an edge fall apart along it", "[schemes][manifold]") {
  const ControlMesh mesh = faces_only({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 1);
  CHECK(cut.cut_vertices == 2);
  CHECK(pieces(mesh, cut) == std::vector{3, 3, 1, 1, 1});
  for (const std::size_t corner : {0u, 3u, 6u}) {
    const int a = vertices_of(cut)[corner], b = vertices_of(cut)[corner + 1];
    CHECK(cut.edge_sharpness(a, b) == infinite);
    CHECK(cut.vertex_sharpness[static_cast<std::size_t>(a)] == infinite);
    CHECK(cut.vertex_sharpness[static_cast<std::size_t>(b)] == infinite);
  }
  check_holds<Loop>(mesh);
}

TEST_CASE("A bow-tie is cut at its knot, which is a corner in every boundary mode", "[schemes][manifold]") {
  ControlMesh mesh = faces_only({{0, 1, 2}, {0, 3, 4}});
  for (const auto mode : {BoundaryInterpolation::edge_and_corner, BoundaryInterpolation::edge_only}) {
    mesh.boundary = mode;
    const ManifoldMesh cut = cut_of(mesh);
    CHECK(cut.cut_edges == 0);
    CHECK(cut.cut_vertices == 1);
    CHECK(pieces(mesh, cut) == std::vector{2, 1, 1, 1, 1});
    CHECK(vertices_of(cut) == std::vector{0, 1, 2, 5, 3, 4});
    CHECK(cut.vertex_sharpness[0] == infinite);
    CHECK(cut.vertex_sharpness[5] == infinite);
    CHECK(cut.vertex_sharpness[1] == (mode == BoundaryInterpolation::edge_only ? 0 : infinite));
  }
  check_holds<Loop>(mesh);
}

TEST_CASE("Two closed bodies that touch in a vertex come apart there", "[schemes][manifold]") {
  const ControlMesh mesh =
      faces_only({{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {6, 5, 4}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 0);
  CHECK(pieces(mesh, cut) == std::vector{2, 1, 1, 1, 1, 1, 1});
  CHECK(cut.vertex_sharpness == std::vector<float>{infinite, 0, 0, 0, 0, 0, 0, infinite});
  CHECK(cut.sharp_edges.empty());
  check_holds<Loop>(mesh);
}

TEST_CASE("Neighbours of opposite winding are cut apart", "[schemes][manifold]") {
  const ControlMesh mesh = faces_only({{0, 1, 2}, {0, 1, 3}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 1);
  CHECK(pieces(mesh, cut) == std::vector{2, 2, 1, 1});
  check_holds<Loop>(mesh);
}

TEST_CASE("A cut is no boundary: beside it faces keep their limit in every boundary mode", "[schemes][manifold]") {
  // One inner face of a sheet turned over: cut along all its edges. Inner faces: 5, 6, 9, 10.
  ControlMesh mesh = sheet("catmark", 4, 4);
  std::reverse(mesh.face_vertices.begin() + 20, mesh.face_vertices.begin() + 24);
  mesh.boundary = BoundaryInterpolation::none;
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 4);
  CHECK(cut.cut_vertices == 4);
  CHECK(cut.origin.size() == 29);
  for (int f = 0; f < 16; ++f) {
    CAPTURE(f);
    CHECK((cut.has_limit[static_cast<std::size_t>(f)] != 0) == (f == 5 || f == 6 || f == 9 || f == 10));
  }
  check_holds<CatmullClark>(mesh);
}

TEST_CASE("Fins along a crease leave the vertices between smooth along it", "[schemes][manifold]") {
  // Three half-planes of two quads each around the line 0-1-2: vertex 1 has two non-manifold edges, no boundary edge
  // and 6 faces to 5 edges.
  std::vector<std::vector<int>> faces;
  for (int fin = 0; fin < 3; ++fin)
    for (int j = 0; j < 2; ++j) {
      const int outer = 3 + 3 * fin + j;
      faces.push_back({j, j + 1, outer + 1, outer});
    }
  const ControlMesh mesh = faces_only(faces);
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 2);
  CHECK(cut.cut_vertices == 3);
  CHECK(pieces(mesh, cut) == std::vector{3, 3, 3, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  for (std::size_t v = 0; v < cut.origin.size(); ++v) {
    if (cut.origin[v] == 1) CHECK(cut.vertex_sharpness[v] == 0);
    if (cut.origin[v] == 0 || cut.origin[v] == 2) CHECK(cut.vertex_sharpness[v] == infinite);
  }
  check_holds<CatmullClark>(mesh);
}

TEST_CASE("A face given twice is cut off from itself", "[schemes][manifold]") {
  const ControlMesh mesh = faces_only({{0, 1, 2}, {0, 1, 2}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 3);
  CHECK(pieces(mesh, cut) == std::vector{2, 2, 2});
  check_holds<Loop>(mesh);
}

TEST_CASE("A vertex repeated in a row is one vertex with a sharp edge of no length", "[schemes][manifold]") {
  const ControlMesh mesh = faces_only({{0, 1, 1, 2}, {2, 1, 3, 4}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 1);
  CHECK(cut.cut_vertices == 0);
  CHECK(vertices_of(cut) == mesh.face_vertices);
  CHECK(cut.edge_sharpness(1, 1) == infinite);
  CHECK(cut.edge_sharpness(1, 2) == 0);
  CHECK(cut.has_limit == std::vector<char>{1, 1});
  check_holds<CatmullClark>(mesh);
}

TEST_CASE("A vertex repeated across a face is cut; a face without three steps keeps its corners apart",
          "[schemes][manifold]") {
  const ControlMesh mesh = faces_only({{0, 1, 0, 2}, {3, 4, 4}, {5, 6, 7}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 4);  // 0-1, 0-2 and 3-4, each with one face twice, and 4-4
  CHECK(pieces(mesh, cut) == std::vector{2, 1, 1, 1, 2, 1, 1, 1});
  CHECK(cut.has_limit == std::vector<char>{1, 1, 1});
  check_holds<CatmullClark>(mesh);
}

TEST_CASE("A face that its neighbours bring back to a vertex is cut off", "[schemes][manifold]") {
  // Edge 0-1 is folded within the first face, and the second closes the fan of its two corners at 1.
  const ControlMesh mesh = faces_only({{0, 1, 3, 2, 1}, {1, 2, 3}});
  const ManifoldMesh cut = cut_of(mesh);
  CHECK(cut.cut_edges == 4);
  CHECK(pieces(mesh, cut) == std::vector{1, 3, 2, 2});
  check_holds<CatmullClark>(mesh);
}

TEST_CASE("Any soup of faces can be held, vertices repeated or not", "[schemes][manifold]") {
  Random random(11);
  for (int round = 0; round < 500; ++round) {
    CAPTURE(round);
    std::vector<std::vector<int>> faces(static_cast<std::size_t>(1 + random.index(8)));
    for (std::vector<int>& face : faces)
      for (int i = 3 + random.index(4); i > 0; --i) face.push_back(random.index(9));
    check_holds<CatmullClark>(faces_only(faces));
  }
}

}  // namespace shaolin
