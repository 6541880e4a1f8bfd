#include "mesh.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "errors.h"
#include "sharpness.h"

namespace shaolin {

Mesh::Mesh(const ManifoldMesh& topology, std::vector<Vec3> points)
    : points_(std::move(points)),
      face_offsets_(topology.face_offsets),
      face_vertices_(topology.face_vertices),
      vertex_sharpness_(topology.vertex_sharpness),
      is_cone_(topology.is_cone),
      has_limit_(topology.has_limit) {
  corner_at_.assign(points_.size(), {-1, 0});
  build_half_edges();
  number_sides();
  set_edge_sharpness(topology);
}

void Mesh::set_edge_sharpness(const ManifoldMesh& topology) {
  edge_sharpness_.resize(connectivity_.n_edges());
  std::vector<SemiSharpEdges> around(points_.size(), SemiSharpEdges(topology.crease_method));
  for (const int e : edges()) {
    const Edge ends = edge(e);
    const float sharpness = topology.edge_sharpness(ends.a, ends.b);
    edge_sharpness_[static_cast<std::size_t>(e)] = {sharpness, 0, 0};
    around[static_cast<std::size_t>(ends.a)].add(sharpness);
    around[static_cast<std::size_t>(ends.b)].add(sharpness);
  }
  for (const int e : edges()) {
    const Edge ends = edge(e);
    edge_sharpness_[static_cast<std::size_t>(e)] = {ends.sharpness,
                                                    around[static_cast<std::size_t>(ends.a)].decayed(ends.sharpness),
                                                    around[static_cast<std::size_t>(ends.b)].decayed(ends.sharpness)};
  }
}

/// The kernel gets every face with repeated vertices taken together; cut_to_manifold leaves at least three.
void Mesh::build_half_edges() {
  connectivity_.reserve(points_.size(), face_vertices_.size(), has_limit_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) connectivity_.new_vertex();
  std::vector<OpenMesh::VertexHandle> handles;
  for (const int f : faces()) {
    handles.clear();
    const std::span<const int> v = face(f);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (v[i] != v[(i + 1) % v.size()]) handles.emplace_back(v[i]);
    assert(handles.size() >= 3);
    const OpenMesh::FaceHandle handle = connectivity_.add_face(handles.data(), handles.size());
    if (!handle.is_valid())
      throw InputError("face " + std::to_string(f) + " does not fit its neighbours in the half-edge mesh");
    assert(handle.idx() == f);
    for (std::size_t i = 0; i < v.size(); ++i) corner_at_[static_cast<std::size_t>(v[i])] = {f, static_cast<int>(i)};
  }
}

Mesh::Edge Mesh::edge(int edge) const {
  const HalfEdge half = connectivity_.halfedge_handle(OpenMesh::EdgeHandle(edge), 0);
  const auto& [sharpness, half_a, half_b] = edge_sharpness_[static_cast<std::size_t>(edge)];
  return {connectivity_.from_vertex_handle(half).idx(), connectivity_.to_vertex_handle(half).idx(), sharpness, half_a,
          half_b};
}

void Mesh::number_sides() {
  face_sides_.resize(face_vertices_.size());
  place_of_half_edge_.resize(connectivity_.n_halfedges());
  for (const int f : faces()) {
    const std::span<const int> v = face(f);
    HalfEdge half = connectivity_.halfedge_handle(OpenMesh::FaceHandle(f));
    std::size_t place = 0;
    while (v[place] != connectivity_.from_vertex_handle(half).idx() ||
           v[(place + 1) % v.size()] != connectivity_.to_vertex_handle(half).idx())
      ++place;
    for (std::size_t i = 0; i < v.size(); ++i, place = (place + 1) % v.size()) {
      int& side = face_sides_[static_cast<std::size_t>(first_corner(f)) + place];
      if (v[place] == v[(place + 1) % v.size()]) {
        side = edge_count() + degenerate_side_count_++;
      } else {
        side = connectivity_.edge_handle(half).idx();
        place_of_half_edge_[static_cast<std::size_t>(half.idx())] = static_cast<int>(place);
        half = connectivity_.next_halfedge_handle(half);
      }
    }
  }
}

/// The half-edge that leaves a corner along its side.
Mesh::HalfEdge Mesh::half_edge(Corner corner) const {
  const OpenMesh::VertexHandle from(vertex_at(corner));
  const HalfEdge half = connectivity_.halfedge_handle(OpenMesh::EdgeHandle(side(corner)), 0);
  return connectivity_.from_vertex_handle(half) == from ? half : connectivity_.opposite_halfedge_handle(half);
}

/// The corner at `vertex` of the face beside a half-edge; face -1 outside the boundary. Where the face repeats the
/// vertex it is the last of the repeats if the half-edge leaves it, the first if the half-edge enters it.
Mesh::Corner Mesh::corner_of(HalfEdge half_edge, int vertex) const {
  const OpenMesh::FaceHandle handle = connectivity_.face_handle(half_edge);
  if (!handle.is_valid()) return {-1, 0};
  const int place = place_of_half_edge_[static_cast<std::size_t>(half_edge.idx())];
  const bool leaves = connectivity_.from_vertex_handle(half_edge).idx() == vertex;
  return {handle.idx(), leaves ? place : (place + 1) % face_size(handle.idx())};
}

/// Across the side that leaves the corner; face -1 at a boundary or a side between equal vertices.
Mesh::Corner Mesh::next_clockwise(Corner corner) const {
  if (repeats_next(corner)) return {-1, 0};
  return corner_of(connectivity_.opposite_halfedge_handle(half_edge(corner)), vertex_at(corner));
}

/// Across the side that enters the corner.
Mesh::Corner Mesh::next_counter_clockwise(Corner corner) const {
  const Corner last = previous(corner);
  if (repeats_next(last)) return {-1, 0};
  return corner_of(connectivity_.opposite_halfedge_handle(half_edge(last)), vertex_at(corner));
}

/// The side that leaves a corner, as a spoke of the vertex at one of its ends.
Ring::Spoke Mesh::spoke(Corner corner, int from) const {
  if (repeats_next(corner)) return {from, side(corner), infinite_sharpness, infinite_sharpness, infinite_sharpness};
  const Edge e = edge(side(corner));
  if (e.a == from) return {e.b, side(corner), e.sharpness, e.half_a, e.half_b};
  return {e.a, side(corner), e.sharpness, e.half_b, e.half_a};
}

Ring Mesh::ring(Corner corner) const {
  const auto is = [](Corner a, Corner b) { return a.face == b.face && a.place == b.place; };
  Corner first = corner;
  for (Corner before = next_clockwise(first); before.face >= 0; before = next_clockwise(first)) {
    first = before;
    if (is(first, corner)) break;
  }

  Ring ring;
  ring.vertex = vertex_at(corner);
  ring.sharpness = vertex_sharpness(ring.vertex);
  ring.cone = is_cone(ring.vertex);
  ring.closed = false;
  for (Corner at = first; at.face >= 0;) {
    ring.faces.push_back(face_from(at));
    ring.spokes.push_back(spoke(at, ring.vertex));
    const Corner after = next_counter_clockwise(at);
    if (after.face < 0) ring.spokes.push_back(spoke(previous(at), ring.vertex));
    ring.closed = after.face >= 0 && is(after, first);
    if (ring.closed) break;
    at = after;
  }
  return ring;
}

Neighbourhood Mesh::neighbourhood(Corner first, int radius) const {
  Neighbourhood result;
  result.face = face_from(first);
  std::vector<Corner> inner;
  std::vector<int> seen;
  const int size = result.face.size();
  for (int i = 0; i < size; ++i) {
    inner.push_back({first.face, (first.place + i) % size});
    seen.push_back(result.face.vertex(i));
  }
  for (std::size_t done = 0; radius > 0; --radius) {
    const std::size_t end = inner.size();
    for (; done < end; ++done) {
      result.rings.push_back(ring(inner[done]));
      if (radius == 1) continue;
      for (const FaceSides& f : result.rings.back().faces)
        for (int i = 0; i < f.size(); ++i) {
          if (std::find(seen.begin(), seen.end(), f.vertex(i)) != seen.end()) continue;
          seen.push_back(f.vertex(i));
          inner.push_back(corner_at(f.vertex(i)));
        }
    }
  }
  return result;
}

TriangleMesh::TriangleMesh(const ManifoldMesh& topology, std::vector<Vec3> points) : Mesh(topology, std::move(points)) {
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
