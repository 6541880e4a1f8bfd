#include "tools/stress/sites.h"

#include <algorithm>
#include <map>
#include <set>

namespace shaolin::stress {

namespace {

/// Of an edge by its lower and its higher vertex.
using Ends = std::pair<int, int>;
Ends ends_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

struct Incidence {
  std::map<int, VertexSite> corners;  ///< by vertex
  std::map<Ends, EdgeSite> edges;
  std::map<int, std::set<int>> neighbours;  ///< of a vertex, along edges of faces with a limit
};

Incidence incidence_of(const LimitSurface& surface) {
  const ControlMesh& mesh = surface.control_mesh();
  Incidence result;
  for (int face = 0; face < surface.face_count(); ++face) {
    if (!surface.has_limit(face)) continue;
    const auto vertices = mesh.face(face);
    const int size = mesh.face_size(face);
    for (int k = 0; k < size; ++k) {
      const int a = vertices[static_cast<std::size_t>(k)], b = vertices[static_cast<std::size_t>((k + 1) % size)];
      result.corners[a].push_back(at_corner(surface, face, k));
      if (a == b) continue;
      result.edges[ends_of(a, b)].sides.push_back({face, k, a > b});
      result.neighbours[a].insert(b);
      result.neighbours[b].insert(a);
    }
  }
  return result;
}

std::set<Ends> creases_of(const Incidence& incidence, const ControlMesh& mesh) {
  std::set<Ends> creases;
  for (const auto& [ends, edge] : incidence.edges)
    if (edge.sides.size() != 2) creases.insert(ends);
  for (const SharpEdge& edge : mesh.sharp_edges)
    if (edge.sharpness > 0 && incidence.edges.contains(ends_of(edge.a, edge.b)))
      creases.insert(ends_of(edge.a, edge.b));
  return creases;
}

}  // namespace

SurfaceParameter at_corner(const LimitSurface& surface, int face, int k) {
  static constexpr double quad[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  if (surface.sub_count(face) > 1) return {face, k, 0, 0};
  const double* at = surface.triangular() ? triangle[k] : quad[k];
  return {face, 0, at[0], at[1]};
}

SurfaceParameter on_edge(const LimitSurface& surface, const EdgeSite::Side& side, double along) {
  const int size = surface.control_mesh().face_size(side.face);
  const double far = 1 - along, from = side.backward ? far : along, to = side.backward ? along : far;
  // A side of an n-gon is half in the quad of the corner where it begins, half in that of the next.
  if (surface.sub_count(side.face) > 1)
    return from < 0.5 ? SurfaceParameter{side.face, side.corner, 2 * from, 0}
                      : SurfaceParameter{side.face, (side.corner + 1) % size, 0, 2 * to};
  switch (side.corner) {
    case 0:
      return {side.face, 0, from, 0};
    case 1:
      return surface.triangular() ? SurfaceParameter{side.face, 0, 1 - from, from}
                                  : SurfaceParameter{side.face, 0, 1, from};
    case 2:
      return surface.triangular() ? SurfaceParameter{side.face, 0, 0, to} : SurfaceParameter{side.face, 0, to, 1};
    default:
      return {side.face, 0, 0, to};
  }
}

Sites::Sites(const LimitSurface& surface) {
  const ControlMesh& mesh = surface.control_mesh();
  const Incidence incidence = incidence_of(surface);
  const std::set<Ends> sharp = creases_of(incidence, mesh);
  std::map<int, int> creases_at;
  for (const auto& [a, b] : sharp) ++creases_at[a], ++creases_at[b];
  std::set<int> tagged(mesh.cones.begin(), mesh.cones.end());
  for (const SharpVertex& corner : mesh.sharp_vertices) tagged.insert(corner.vertex);

  for (const auto& [vertex, corners] : incidence.corners) {
    vertices.push_back(corners);
    const std::size_t regular = surface.triangular() ? 6 : 4, valence = incidence.neighbours.at(vertex).size();
    const int creases_here = creases_at[vertex];
    if (creases_here == 0 ? valence != regular
                          : creases_here != 2 || valence != regular / 2 + 1 || corners.size() > regular)
      extraordinary.push_back(corners);
    else if (tagged.contains(vertex))
      extraordinary.push_back(corners);
  }
  for (const auto& [ends, edge] : incidence.edges) {
    edges.push_back(edge);
    if (sharp.contains(ends)) creases.push_back(edge);
  }
  for (int face = 0; face < surface.face_count(); ++face) {
    if (!surface.has_limit(face)) continue;
    VertexSite middle;
    for (int sub = 0; sub < surface.sub_count(face); ++sub) {
      pieces.emplace_back(face, sub);
      middle.push_back({face, sub, 1, 1});
    }
    if (middle.size() > 1) extraordinary.push_back(middle);
  }
}

}  // namespace shaolin::stress
