// Half-edges: pairs, steps, and what is no manifold.
#include "schemes/half_edges.h"

#include <set>

#include "tests/catch.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

namespace {

HalfEdges half_edges_of(const std::vector<std::vector<int>>& faces) {
  PolygonMesh mesh;
  int most = 0;
  for (const std::vector<int>& face : faces) {
    mesh.add_face(face);
    most = std::max(most, *std::max_element(face.begin(), face.end()));
  }
  mesh.positions.resize(static_cast<std::size_t>(most) + 1, Vec3::Zero());
  return HalfEdges(std::make_shared<const PolygonMesh>(std::move(mesh)));
}

/// By their ends alone.
void check_pairs(const HalfEdges& half_edges) {
  for (int s = 0; s < half_edges.side_count(); ++s) {
    CAPTURE(s);
    CHECK(half_edges.previous(half_edges.next(s)) == s);
    CHECK(half_edges.face(half_edges.next(s)) == half_edges.face(s));
    CHECK(half_edges.from(half_edges.next(s)) == half_edges.to(s));
    CHECK(half_edges.first(half_edges.face(s)) + half_edges.place(s) == s);
    const int twin = half_edges.twin(s);
    CHECK(half_edges.twin(twin) == s);
    int with_same_ends = 0;
    for (int other = 0; other < half_edges.side_count(); ++other)
      with_same_ends += std::minmax(half_edges.from(other), half_edges.to(other)) ==
                        std::minmax(half_edges.from(s), half_edges.to(s));
    if (twin != s) {
      CHECK(half_edges.from(twin) == half_edges.to(s));
      CHECK(half_edges.to(twin) == half_edges.from(s));
      CHECK(with_same_ends == 2);
    } else if (with_same_ends == 2 && !half_edges.is_degenerate(s)) {
      CHECK(half_edges.misfit() >= 0);
    }
    if (const int next = half_edges.counter_clockwise(s); next >= 0 && half_edges.misfit() < 0) {
      CHECK(half_edges.from(next) == half_edges.from(s));
      if (half_edges.degenerate_side_count() == 0) CHECK(half_edges.clockwise(next) == s);
    }
  }
}

}  // namespace

TEST_CASE("Half-edges of closed and open meshes are paired by their ends", "[schemes][half_edges]") {
  for (const ControlMesh& mesh : {torus("catmark", 4, 5), torus("loop", 4, 5), sheet("catmark", 3, 2), prism(5)}) {
    const HalfEdges half_edges(std::make_shared<const ControlMesh>(mesh));
    CHECK(half_edges.is_manifold());
    CHECK(half_edges.misfit() == -1);
    check_pairs(half_edges);
    int alone = 0;
    for (int s = 0; s < half_edges.side_count(); ++s) alone += half_edges.twin(s) == s;
    CHECK(2 * half_edges.edge_count() == half_edges.side_count() + alone);
  }
}

TEST_CASE("Half-edges of any faces agree with a search over all sides", "[schemes][half_edges]") {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    CAPTURE(round);
    const int corners = random.index(3);  // triangles, quads, or both and more
    std::vector<std::vector<int>> faces(static_cast<std::size_t>(1 + random.index(6)));
    for (std::vector<int>& face : faces)
      for (int i = corners < 2 ? 3 + corners : 3 + random.index(4); i > 0; --i) face.push_back(random.index(7));
    check_pairs(half_edges_of(faces));
  }
}

TEST_CASE("What is no manifold is told", "[schemes][half_edges]") {
  CHECK(half_edges_of({{0, 1, 2}, {2, 1, 3}}).is_manifold());
  CHECK_FALSE(half_edges_of({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).is_manifold());  // three faces at an edge
  CHECK_FALSE(half_edges_of({{0, 1, 2}, {0, 1, 3}}).is_manifold());             // wound against each other
  CHECK_FALSE(half_edges_of({{0, 1, 2}, {0, 3, 4}}).is_manifold());             // two fans at 0
  CHECK_FALSE(half_edges_of({{0, 1, 1, 2}}).is_manifold());                     // a side between equal vertices
  CHECK_FALSE(half_edges_of({{0, 1, 0, 2}}).is_manifold());                     // a face beside itself
  CHECK_FALSE(half_edges_of({{0, 1, 2, 0, 3, 4}}).is_manifold());               // a face twice at a vertex
}

}  // namespace shaolin
