#include "tools/cli/mesh_counts.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

namespace shaolin {
namespace {

struct Edge {
  int a, b;
  int faces = 0;
  float sharpness = 0;  ///< by its tag

  bool boundary() const { return faces == 1; }
  bool non_manifold() const { return faces > 2; }
  bool sharp() const { return boundary() || non_manifold() || sharpness > 0; }
};

/// All edges, found by their ends in any order.
class EdgeMap {
 public:
  explicit EdgeMap(const ControlMesh& mesh) {
    for (int f = 0; f < mesh.face_count(); ++f) {
      const auto corners = mesh.face(f);
      for (std::size_t i = 0; i < corners.size(); ++i) add(corners[i], corners[(i + 1) % corners.size()]);
    }
    // A tag on an edge that does not exist has no effect; of two tags on one edge, the later counts.
    for (const SharpEdge& tag : mesh.sharp_edges)
      if (const auto found = edges_.find(key(tag.a, tag.b)); found != edges_.end())
        found->second.sharpness = tag.sharpness;
  }

  auto begin() const { return edges_.begin(); }
  auto end() const { return edges_.end(); }
  std::size_t size() const { return edges_.size(); }

 private:
  static std::uint64_t key(int a, int b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint32_t>(std::max(a, b));
  }
  void add(int a, int b) {
    if (a == b) return;  // a face that repeats a vertex
    ++edges_.try_emplace(key(a, b), Edge{a, b}).first->second.faces;
  }

  std::unordered_map<std::uint64_t, Edge> edges_;
};

/// What meets at a vertex.
struct Star {
  int edges = 0, sharp_edges = 0, boundary_edges = 0;
  int faces = 0;
  float sharpness = 0;  ///< by its tag
  bool cone = false;
};

std::vector<Star> stars(const ControlMesh& mesh, const EdgeMap& edges) {
  std::vector<Star> stars(mesh.positions.size());
  for (const auto& [key, edge] : edges) {
    for (const int vertex : {edge.a, edge.b}) {
      ++stars[vertex].edges;
      stars[vertex].sharp_edges += edge.sharp();
      stars[vertex].boundary_edges += edge.boundary();
    }
  }
  for (const int vertex : mesh.face_vertices) ++stars[vertex].faces;
  for (const SharpVertex& tag : mesh.sharp_vertices) stars[tag.vertex].sharpness = tag.sharpness;
  for (const int vertex : mesh.cones) stars[vertex].cone = true;
  return stars;
}

void count_edges(const EdgeMap& edges, MeshCounts& counts) {
  counts.edges = edges.size();
  for (const auto& [key, edge] : edges) {
    counts.infinite_creases += edge.sharpness >= infinite_sharpness;
    counts.semi_sharp_creases += edge.sharpness > 0 && edge.sharpness < infinite_sharpness;
    counts.boundary_edges += edge.boundary();
    counts.non_manifold_edges += edge.non_manifold();
  }
}

std::size_t& kind_count(const Star& star, BoundaryInterpolation boundary, MeshCounts& counts) {
  const bool boundary_corner = boundary == BoundaryInterpolation::edge_and_corner && star.faces == 1;
  if (star.sharpness > 0 || boundary_corner || star.sharp_edges > 2) return counts.corner;
  if (star.sharp_edges == 2) return counts.crease;
  if (star.sharp_edges == 1) return counts.dart;
  return star.cone ? counts.conical : counts.smooth;
}

void count_vertex(const Star& star, BoundaryInterpolation boundary, int regular_valence, MeshCounts& counts) {
  ++counts.vertices_by_valence[star.edges];
  counts.infinite_corners += star.sharpness >= infinite_sharpness;
  counts.semi_sharp_corners += star.sharpness > 0 && star.sharpness < infinite_sharpness;
  if (star.faces == 0) {
    ++counts.isolated_vertices;
    return;
  }
  const bool at_boundary = star.boundary_edges > 0;
  counts.boundary_vertices += at_boundary;
  // Half of a regular vertex's faces lie at a regular boundary vertex, and one edge more than faces.
  counts.extraordinary += star.edges != (at_boundary ? regular_valence / 2 + 1 : regular_valence);
  ++kind_count(star, boundary, counts);
}

}  // namespace

MeshCounts count(const ControlMesh& mesh, int regular_valence) {
  MeshCounts counts;
  counts.vertices = mesh.positions.size();
  counts.faces = static_cast<std::size_t>(mesh.face_count());
  for (int f = 0; f < mesh.face_count(); ++f) ++counts.faces_by_size[mesh.face_size(f)];
  counts.holes = std::set<int>(mesh.holes.begin(), mesh.holes.end()).size();

  const EdgeMap edges(mesh);
  count_edges(edges, counts);
  for (const Star& star : stars(mesh, edges)) count_vertex(star, mesh.boundary, regular_valence, counts);
  return counts;
}

}  // namespace shaolin
