#pragma once
/// Boxes for faces that nobody has refined yet.
#include <algorithm>
#include <optional>
#include <vector>

#include "../schemes/subdivision_mesh.h"
#include "limit_bounds.h"
#include "refined_bounds.h"
#include "regular_bounds.h"

namespace shaolin {

namespace detail {

/// Where masks have negative weights: of patches two splits down, whose neighbourhoods are a third as wide.
template <Scheme S>
std::vector<Box> split_face_bounds(const SubdivisionMesh<S>& mesh) {
  std::vector<Box> result;
  for (const int f : mesh.faces())
    result.push_back(mesh.has_limit(f) ? split_limit_bound(mesh.patch({f, 0}), 2).with_rounding() : Box());
  return result;
}

/// The hulls of the faces around the corners, expanded where refinement may leave them (under Chaikin's rule, see
/// hull_expansion.h). By what is around vertices, of whatever faces.
template <Scheme S>
std::vector<Box> control_face_bounds(const SubdivisionMesh<S>& mesh) {
  std::vector<Box> around(static_cast<std::size_t>(mesh.vertex_count()));
  std::vector<float> sharpest(around.size(), 0);
  for (const int f : mesh.faces()) {
    Box box;
    for (const int v : mesh.face(f)) box.add(mesh.point(v));
    for (const int v : mesh.face(f)) around[static_cast<std::size_t>(v)].add(box);
  }
  for (const int e : mesh.edges()) {
    const Mesh::Edge edge = mesh.edge(e);
    for (const int v : {edge.a, edge.b}) {
      float& known = sharpest[static_cast<std::size_t>(v)];
      if (is_semi_sharp(edge.sharpness)) known = std::max(known, edge.sharpness);
    }
  }
  std::vector<Box> result;
  result.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const int f : mesh.faces()) {
    Box box;
    float sharpness = 0;
    for (const int v : mesh.face(f)) {
      box.add(around[static_cast<std::size_t>(v)]);
      sharpness = std::max(sharpness, sharpest[static_cast<std::size_t>(v)]);
    }
    result.push_back(box.expanded(hull_expansion(mesh.rules(), sharpness)).with_rounding());
  }
  return result;
}

/// Vertices of faces that repeat a vertex.
inline std::vector<bool> vertices_of_odd_faces(const Mesh& mesh) {
  const HalfEdges& half_edges = mesh.half_edges();
  std::vector<bool> result(static_cast<std::size_t>(mesh.vertex_count()), false);
  for (int side = 0; side < half_edges.side_count(); ++side)
    if (half_edges.is_degenerate(side))
      for (const int v : mesh.face(half_edges.face(side))) result[static_cast<std::size_t>(v)] = true;
  return result;
}

}  // namespace detail

/// For every face a box that holds its limit, with room for rounding: the hull of its Bezier points if it is regular;
/// else from the points that one refinement step makes (RefinedBounds), or under Chaikin's rule and beside faces that
/// repeat a vertex from the control points. O(size), without refining anything, for masks that are convex combinations;
/// else every face is split twice.
template <Scheme S>
std::vector<Box> face_bounds(const SubdivisionMesh<S>& mesh) {
  if (!mesh.table().is_convex()) return detail::split_face_bounds(mesh);
  const bool is_chaikin = mesh.rules().creases == CreaseMethod::chaikin;
  const bool has_odd = mesh.half_edges().degenerate_side_count() > 0;
  std::vector<Box> result = is_chaikin || has_odd ? detail::control_face_bounds(mesh)
                                                  : std::vector<Box>(static_cast<std::size_t>(mesh.face_count()));
  const std::vector<bool> is_odd = has_odd ? detail::vertices_of_odd_faces(mesh) : std::vector<bool>();
  std::optional<RefinedBounds<S>> refined;
  for (const int f : mesh.faces()) {
    Box& box = result[static_cast<std::size_t>(f)];
    if (basis_of(mesh.rules().scheme) == Basis::spline)
      if (const std::optional<Box> regular = regular_bound(mesh, f)) {
        box = *regular;
        continue;
      }
    const auto is_beside_odd = [&](int v) { return is_odd[static_cast<std::size_t>(v)]; };
    if (is_chaikin || (has_odd && std::ranges::any_of(mesh.face(f), is_beside_odd))) continue;
    if (!refined) refined.emplace(mesh);
    box = (*refined)(f).with_rounding();
  }
  return result;
}

}  // namespace shaolin
