// The mesh hierarchy: navigation against positions in the plane, counts against Euler's formula, limits against values
// worked out by hand.
#include "schemes/mesh.h"

#include <map>
#include <set>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/subdivision_mesh.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

std::vector<int> ends_of(const Ring& ring) {
  std::vector<int> ends;
  for (const Ring::Spoke& spoke : ring.spokes) ends.push_back(spoke.end);
  return ends;
}

/// A triangle mesh keeps places for face points that it does not have: vertices without a face are not counted.
int used_vertices(const Mesh& mesh) {
  int count = 0;
  for (const int v : mesh.vertices()) count += mesh.corner_at(v).face >= 0;
  return count;
}

int corner_count(const Mesh& mesh) {
  int count = 0;
  for (const int f : mesh.faces()) count += mesh.face_size(f);
  return count;
}

struct KnownTopology {
  ControlMesh mesh;
  int euler;  ///< V - E + F
};

template <Scheme S>
std::vector<KnownTopology> known_topologies() {
  std::vector<KnownTopology> result{{poles(S::name, 5), 2}, {torus(S::name, 4, 5), 0}, {sheet(S::name, 2, 3), 1}};
  if (S::face_kind == FaceKind::quad) result.push_back({prism(5), 2});
  return result;
}

}  // namespace

TEST_CASE("A ring on the boundary runs counter-clockwise from the boundary edge", "[schemes][mesh]") {
  const SubdivisionMesh<CatmullClark> quads(sheet("catmark", 2, 2));
  CHECK(ends_of(quads.ring(quads.corner_at(0))) == std::vector{1, 3});
  CHECK(ends_of(quads.ring(quads.corner_at(1))) == std::vector{2, 4, 0});
  const SubdivisionMesh<Loop> triangles(sheet("loop", 2, 2));
  CHECK(ends_of(triangles.ring(triangles.corner_at(0))) == std::vector{1, 4, 3});
  CHECK(ends_of(triangles.ring(triangles.corner_at(1))) == std::vector{2, 5, 4, 0});
  CHECK(ends_of(triangles.ring(triangles.corner_at(2))) == std::vector{5, 1});
}

TEMPLATE_TEST_CASE("Every ring is the same from every corner, a closed one turned", "[schemes][mesh]", Loop,
                   CatmullClark) {
  for (const KnownTopology& shape : known_topologies<TestType>()) {
    const SubdivisionMesh<TestType> mesh(shape.mesh);
    for (const int f : mesh.faces())
      for (int place = 0; place < mesh.face_size(f); ++place) {
        const Ring ring = mesh.ring({f, place});
        const std::size_t n = ring.spokes.size();
        CAPTURE(f, place);
        REQUIRE(ring.vertex == mesh.face(f)[static_cast<std::size_t>(place)]);
        REQUIRE(ring.faces.size() == (ring.closed ? n : n - 1));
        CHECK(ring.closed == (shape.euler != 1 || n == static_cast<std::size_t>(TestType::regular_valence)));
        if (ring.closed) {
          CHECK(ring.faces[0].id() == f);
        } else {
          CHECK(ends_of(ring) == ends_of(mesh.ring(mesh.corner_at(ring.vertex))));
        }
        std::set<int> edges;
        for (std::size_t i = 0; i < n; ++i) edges.insert(ring.spokes[i].edge);
        CHECK(edges.size() == n);
        for (std::size_t i = 0; i < ring.faces.size(); ++i) {
          CHECK(ring.faces[i].vertex(0) == ring.vertex);
          CHECK(ring.faces[i].vertex(1) == ring.spokes[i].end);
          CHECK(ring.faces[i].last_vertex() == ring.spokes[(i + 1) % n].end);
          CHECK(ring.faces[i].side(0) == ring.spokes[i].edge);
        }
      }
  }
}

TEST_CASE("Around an interior vertex of a flat sheet each spoke lies left of the one before", "[schemes][mesh]") {
  const SubdivisionMesh<Loop> mesh(sheet("loop", 4, 4));
  const Ring ring = mesh.ring(mesh.corner_at(12));
  REQUIRE(ring.closed);
  REQUIRE(ring.spokes.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 a = mesh.point(ring.spokes[i].end) - mesh.point(12);
    const Vec3 b = mesh.point(ring.spokes[(i + 1) % 6].end) - mesh.point(12);
    CHECK(a.cross(b).z() > 0.5);
  }
}

TEMPLATE_TEST_CASE("Iterators visit every element once", "[schemes][mesh]", Loop, CatmullClark) {
  for (const KnownTopology& shape : known_topologies<TestType>()) {
    const SubdivisionMesh<TestType> mesh(shape.mesh);
    CHECK(mesh.vertex_count() - mesh.edge_count() + mesh.face_count() == shape.euler);
    int next = 0;
    for (const int v : mesh.vertices()) {
      CHECK(v == next++);
      const Mesh::Corner corner = mesh.corner_at(v);
      CHECK(mesh.face(corner.face)[static_cast<std::size_t>(corner.place)] == v);
    }
    CHECK(next == mesh.vertex_count());
    std::map<std::pair<int, int>, int> sides;
    for (const int f : mesh.faces()) {
      const auto v = mesh.face(f);
      for (std::size_t i = 0; i < v.size(); ++i) ++sides[std::minmax({v[i], v[(i + 1) % v.size()]})];
    }
    CHECK(static_cast<int>(sides.size()) == mesh.edge_count());
    int boundary = 0;
    for (const int e : mesh.edges()) {
      const Mesh::Edge edge = mesh.edge(e);
      const int faces = sides[std::minmax(edge.a, edge.b)];
      CHECK((faces == 1 || faces == 2));
      CHECK(edge.sharpness == (faces == 1 ? infinite_sharpness : 0));
      boundary += faces == 1;
    }
    CHECK(boundary == (shape.euler == 1 ? 10 : 0));
  }
}

TEST_CASE("A vertex without a face has no corner", "[schemes][mesh]") {
  ControlMesh control = poles("loop", 4);
  control.positions.emplace_back(9, 9, 9);
  const SubdivisionMesh<Loop> mesh(control);
  CHECK(mesh.corner_at(6).face == -1);
  CHECK(mesh.vertex_count() == 7);
}

TEST_CASE("A neighbourhood holds the rings of the face's corners in order, then one layer more", "[schemes][mesh]") {
  const SubdivisionMesh<CatmullClark> mesh(sheet("catmark", 5, 5));
  const auto vertices = [&](int radius) {
    const Neighbourhood neighbourhood = mesh.neighbourhood({12, 1}, radius);
    std::vector<int> result;
    for (const Ring& ring : neighbourhood.rings) result.push_back(ring.vertex);
    return result;
  };
  CHECK(vertices(1) == std::vector{15, 21, 20, 14});
  const std::vector<int> two = vertices(2);
  CHECK(std::vector(two.begin(), two.begin() + 4) == std::vector{15, 21, 20, 14});
  CHECK(std::set(two.begin(), two.end()) == std::set{7, 8, 9, 10, 13, 14, 15, 16, 19, 20, 21, 22, 25, 26, 27, 28});
  CHECK(two.size() == 16);
}

TEMPLATE_TEST_CASE("Refinement has the counts of Euler's formula, level by level", "[schemes][mesh]", Loop,
                   CatmullClark) {
  constexpr bool quads = TestType::face_kind == FaceKind::quad;
  for (const KnownTopology& shape : known_topologies<TestType>()) {
    const SubdivisionMesh<TestType> mesh(shape.mesh);
    const auto first = mesh.refine(), second = first->refine();
    const std::vector<const SubdivisionMesh<TestType>*> levels{&mesh, first.get(), second.get()};
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const SubdivisionMesh<TestType>&coarse = *levels[k], &fine = *levels[k + 1];
      CAPTURE(shape.euler, k);
      const int corners = corner_count(coarse);
      CHECK(fine.face_count() == (quads ? corners : 4 * coarse.face_count()));
      CHECK(fine.edge_count() == 2 * coarse.edge_count() + corners);
      CHECK(used_vertices(fine) == used_vertices(coarse) + coarse.edge_count() + (quads ? coarse.face_count() : 0));
      CHECK(used_vertices(fine) - fine.edge_count() + fine.face_count() == shape.euler);
    }
  }
}

TEMPLATE_TEST_CASE("Child k of a face holds its corner k in the parent's orientation", "[schemes][mesh]", Loop,
                   CatmullClark) {
  for (const KnownTopology& shape : known_topologies<TestType>()) {
    const SubdivisionMesh<TestType> mesh(shape.mesh);
    const auto fine = mesh.refine();
    std::set<int> children;
    for (const int f : mesh.faces()) {
      const bool by_corner = TestType::face_kind == FaceKind::quad && mesh.face_size(f) != 4;
      for (int k = 0; k < mesh.child_count(f); ++k) {
        const int child = mesh.child_face(f, k);
        CHECK(children.insert(child).second);
        CHECK(fine->parent_face(child) == f);
        if (k >= mesh.face_size(f)) continue;
        const auto place = static_cast<std::size_t>(by_corner ? 0 : k);
        CHECK(fine->face(child)[place] == mesh.child_of_vertex(mesh.face(f)[static_cast<std::size_t>(k)]));
      }
    }
    CHECK(static_cast<int>(children.size()) == fine->face_count());
  }
}

TEST_CASE("Chord normals are right-handed; a skew quad's is that of its diagonals", "[schemes][mesh]") {
  CHECK((TriangleMesh::chord_normal({{0, 0, 0}, {3, 0, 0}, {1, 2, 0}}) - Vec3::UnitZ()).norm() < 1e-15);
  CHECK((QuadMesh::chord_normal({{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}}) - Vec3::UnitZ()).norm() < 1e-15);
  const SubdivisionMesh<CatmullClark> body(prism(5));
  CHECK((body.chord_normal(0) + Vec3::UnitZ()).norm() < 1e-14);
  CHECK((body.chord_normal(1) - Vec3::UnitZ()).norm() < 1e-14);
}

TEST_CASE("Limits at the vertices of Platonic bodies", "[schemes][mesh]") {
  // Loop, valence 4: (1 - 4 w) p + w sum(neighbours), w = 31/220; an octahedron's neighbours sum to 0.
  const SubdivisionMesh<Loop> octahedron(
      mesh_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
              {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}));
  for (int k = 0; k < 3; ++k) {
    const LimitSample sample = octahedron.limit(0, k);
    const Vec3& p = octahedron.point(octahedron.face(0)[static_cast<std::size_t>(k)]);
    CHECK((sample.position - 24.0 / 55 * p).norm() < 1e-15);
    CHECK((sample.normal - p).norm() < 1e-14);
  }
  // Catmull-Clark, valence 3: (9 p + 4 sum(edge ends) + sum(diagonals)) / 24; a cube's sums are p and -p.
  const SubdivisionMesh<CatmullClark> cube(prism(4));
  for (const int f : cube.faces())
    for (int k = 0; k < 4; ++k) {
      const Vec3& p = cube.point(cube.face(f)[static_cast<std::size_t>(k)]);
      // The prism over a square of circumradius 1 is no cube but its affine image: limits go with it, normals not.
      CHECK((cube.limit(f, k).position - 0.5 * p).norm() < 1e-15);
    }
}

}  // namespace shaolin
