#include "mesh.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "errors.h"
#include "sharpness.h"

namespace shaolin {

Mesh::Mesh(ManifoldMesh topology) : half_edges_(std::move(topology.half_edges)), tags_(points().size(), 0) {
  if (const int side = half_edges_.misfit(); side >= 0)
    throw InputError("face " + std::to_string(half_edges_.face(side)) +
                     " does not fit its neighbours in the half-edge mesh");
  for (const int v : vertices()) {
    const auto at = static_cast<std::size_t>(v);
    if (topology.is_cone[at]) set(v, cone);
    if (!is_sharp(topology.vertex_sharpness[at])) continue;
    set(v, sharp);
    sharp_vertices_.push_back({v, topology.vertex_sharpness[at]});
  }
  if (std::find(topology.has_limit.begin(), topology.has_limit.end(), 0) != topology.has_limit.end())
    has_limit_ = std::move(topology.has_limit);
  set_edge_sharpness(topology);
}

void Mesh::set_edge_sharpness(const ManifoldMesh& topology) {
  if (topology.sharp_edges.empty()) return;
  for (const auto& [key, sharpness] : topology.sharp_edges)
    for (const int end : ManifoldMesh::ends(key)) set(end, sharp_edge);
  std::unordered_map<int, SemiSharpEdges> around;
  for (const int e : edges()) {
    const int a = half_edges_.from(e), b = half_edges_.to(e);
    if (!has_sharp_edge(a) || !has_sharp_edge(b)) continue;
    const float sharpness = topology.edge_sharpness(a, b);
    if (!is_sharp(sharpness)) continue;
    sharp_edges_.push_back({e, sharpness, 0, 0});
    for (const int end : {a, b}) around.try_emplace(end, topology.crease_method).first->second.add(sharpness);
  }
  for (SharpHalves& e : sharp_edges_) {
    e.half_a = around.at(half_edges_.from(e.edge)).decayed(e.sharpness);
    e.half_b = around.at(half_edges_.to(e.edge)).decayed(e.sharpness);
  }
}

float Mesh::sharpness_of(int vertex) const {
  return std::lower_bound(sharp_vertices_.begin(), sharp_vertices_.end(), vertex,
                          [](const SharpVertex& known, int wanted) { return known.vertex < wanted; })
      ->sharpness;
}

Mesh::Edge Mesh::edge(int edge) const {
  Edge result{half_edges_.from(edge), half_edges_.to(edge), 0, 0, 0};
  if (!has_sharp_edge(result.a) || !has_sharp_edge(result.b)) return result;
  const auto found = std::lower_bound(sharp_edges_.begin(), sharp_edges_.end(), edge,
                                      [](const SharpHalves& known, int wanted) { return known.edge < wanted; });
  if (found == sharp_edges_.end() || found->edge != edge) return result;
  return {result.a, result.b, found->sharpness, found->half_a, found->half_b};
}

const std::vector<int>& Mesh::corners_at() const {
  std::call_once(corners_found_, [&] {
    corners_at_.assign(points().size(), -1);
    for (int c = 0; c < half_edges_.side_count(); ++c) corners_at_[static_cast<std::size_t>(half_edges_.from(c))] = c;
  });
  return corners_at_;
}

Mesh::Corner Mesh::corner_at(int vertex) const {
  const int corner = corners_at()[static_cast<std::size_t>(vertex)];
  if (corner < 0) return {-1, 0};
  return {half_edges_.face(corner), half_edges_.place(corner)};
}

/// The side that leaves a corner, as a spoke of the vertex at one of its ends.
Ring::Spoke Mesh::spoke(int side, int from) const {
  if (half_edges_.is_degenerate(side)) return {from, side, infinite_sharpness, infinite_sharpness, infinite_sharpness};
  const int number = half_edges_.edge(side);
  const Edge e = edge(number);
  if (e.a == from) return {e.b, number, e.sharpness, e.half_a, e.half_b};
  return {e.a, number, e.sharpness, e.half_b, e.half_a};
}

Ring Mesh::ring(Corner corner) const { return ring_at(corner_number(corner)); }

Ring Mesh::ring_at(int corner) const {
  int first = corner;
  for (int before = half_edges_.clockwise(first); before >= 0; before = half_edges_.clockwise(first)) {
    first = before;
    if (first == corner) break;
  }

  Ring ring;
  ring.vertex = half_edges_.from(corner);
  ring.sharpness = vertex_sharpness(ring.vertex);
  ring.cone = is_cone(ring.vertex);
  ring.closed = false;
  for (int at = first; at >= 0;) {
    ring.faces.push_back(face_from(at));
    ring.spokes.push_back(spoke(at, ring.vertex));
    const int after = half_edges_.counter_clockwise(at);
    if (after < 0) ring.spokes.push_back(spoke(half_edges_.previous(at), ring.vertex));
    ring.closed = after == first;
    if (ring.closed) break;
    at = after;
  }
  return ring;
}

Neighbourhood Mesh::neighbourhood(Corner first, int radius) const {
  Neighbourhood result;
  result.face = face_from(corner_number(first));
  std::vector<int> inner, seen;
  const int size = result.face.size();
  for (int i = 0; i < size; ++i) {
    inner.push_back(corner_number({first.face, (first.place + i) % size}));
    seen.push_back(result.face.vertex(i));
  }
  for (std::size_t done = 0; radius > 0; --radius) {
    const std::size_t end = inner.size();
    for (; done < end; ++done) {
      result.rings.push_back(ring_at(inner[done]));
      if (radius == 1) continue;
      for (const FaceSides& f : result.rings.back().faces)
        for (int i = 0; i < f.size(); ++i) {
          if (std::find(seen.begin(), seen.end(), f.vertex(i)) != seen.end()) continue;
          seen.push_back(f.vertex(i));
          inner.push_back(corners_at()[static_cast<std::size_t>(f.vertex(i))]);
        }
    }
  }
  return result;
}

TriangleMesh::TriangleMesh(ManifoldMesh topology) : Mesh(std::move(topology)) {
  for (const int f : faces())
    if (face_size(f) != 3)
      throw InputError("face " + std::to_string(f) + " has " + std::to_string(face_size(f)) +
                       " corners; a triangle scheme such as Loop expects triangles only");
}

Vec3 TriangleMesh::chord_normal(const std::vector<Vec3>& p) { return (p[1] - p[0]).cross(p[2] - p[0]).normalized(); }

Vec3 QuadMesh::chord_normal(const std::vector<Vec3>& p) {
  Vec3 sum = Vec3::Zero();
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) sum += (p[(i + 1) % n] - p[i]).cross(p[(i + 2) % n] - p[(i + 1) % n]);
  return sum.normalized();
}

}  // namespace shaolin
