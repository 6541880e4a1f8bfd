#pragma once
/// Boxes for faces that nobody has refined yet.
#include <algorithm>
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

/// Under Chaikin's rule: the hulls of the faces around the corners, expanded.
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

template <Scheme S>
std::vector<Box> refined_face_bounds(const SubdivisionMesh<S>& mesh) {
  const RefinedBounds<S> refined(mesh);
  const double share = refined.outside_share();
  std::vector<Box> result;
  result.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (const int f : mesh.faces()) {
    Box box;
    for (const int v : mesh.face(f)) box.add(refined.around(v));
    if (!repeats_vertex(mesh.face(f))) {
      const Box own = refined.of(f);
      box = {own.lower.cwiseMin((1 - share) * own.lower + share * box.lower),
             own.upper.cwiseMax((1 - share) * own.upper + share * box.upper)};
    }
    result.push_back(box.with_rounding());
  }
  return result;
}

}  // namespace detail

/// For every face a box that holds its limit, with room for rounding: the hull of its Bezier points if it is regular;
/// else from the points that one refinement step makes (RefinedBounds), expanded where refinement may leave the hull
/// (under Chaikin's rule, see hull_expansion.h; there it is the hull of the control points). O(size), without refining
/// anything, for masks that are convex combinations; else every face is split twice.
template <Scheme S>
std::vector<Box> face_bounds(const SubdivisionMesh<S>& mesh) {
  if (!mesh.table().is_convex()) return detail::split_face_bounds(mesh);
  std::vector<Box> result = mesh.rules().creases == CreaseMethod::chaikin ? detail::control_face_bounds(mesh)
                                                                          : detail::refined_face_bounds(mesh);
  if (basis_of(mesh.rules().scheme) == Basis::spline) {
    const RegularBounds<S> regular(mesh);
    for (const int f : mesh.faces())
      if (regular.is_regular(f)) result[static_cast<std::size_t>(f)] = regular(f);
  }
  return result;
}

}  // namespace shaolin
