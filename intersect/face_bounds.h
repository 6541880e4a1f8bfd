#pragma once
/// Boxes for faces that nobody has refined yet, half as wide as their control neighbourhoods.
#include <optional>
#include <span>
#include <vector>

#include "../schemes/subdivision_mesh.h"
#include "limit_bounds.h"
#include "regular_bounds.h"

namespace shaolin {

namespace detail {

/// a + s b for boxes and points, with s >= 0.
inline Box sum(const Box& a, const Box& b, double s) { return {a.lower + s * b.lower, a.upper + s * b.upper}; }
inline Box scaled(const Box& a, double s) { return {s * a.lower, s * a.upper}; }

}  // namespace detail

/// For every vertex a box of the points that one refinement step makes around it: of itself, its edges and its faces.
/// A face's limit lies in the hull of the points around its corners, so in the union of their boxes. Only for schemes
/// whose masks are not negative.
///
/// The new points are bounded from two boxes, of the neighbours along edges and of the new face points (quad split), by
/// the scheme's masks in interval arithmetic: an edge point is end (v + neighbour) + side (two face points, or on
/// triangles two neighbours), a vertex point is the mask's mean of v, neighbours and face points; every crease or
/// corner rule, and every blend with one, lies between v, the midpoint with a neighbour, and the smooth point.
/// O(size), without walking rings.
template <Scheme S>
std::vector<Box> corner_bounds(const SubdivisionMesh<S>& mesh) {
  constexpr bool quads = S::face_kind == FaceKind::quad;
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::vector<Box> neighbours(count), face_points(count);
  std::vector<int> valence(count, 0);
  for (const int f : mesh.faces()) {
    const std::span<const int> v = mesh.face(f);
    const std::size_t n = v.size();
    const Vec3 middle = face_point({mesh.points().data(), v.data(), static_cast<int>(n)});
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(v[i]);
      neighbours[at].add(mesh.point(v[(i + 1) % n]));
      neighbours[at].add(mesh.point(v[(i + n - 1) % n]));
      face_points[at].add(middle);
      ++valence[at];
    }
  }

  std::vector<Box> result(count);
  std::vector<EdgeMask> edge_masks;
  for (const int triangles : {0, 1, 2}) edge_masks.push_back(mesh.rules().edge(triangles));
  for (const int v : mesh.vertices()) {
    const auto at = static_cast<std::size_t>(v);
    const int n = valence[at];
    if (n == 0) continue;
    const Box point{mesh.point(v), mesh.point(v)};
    const Box& sides = quads ? face_points[at] : neighbours[at];
    const Box ends = detail::sum(point, neighbours[at], 1);
    Box& box = result[at];
    box.add(point);
    box.add(detail::scaled(ends, 0.5));
    for (const EdgeMask& edge : edge_masks) box.add(detail::sum(detail::scaled(ends, edge.end), sides, 2 * edge.side));
    if (quads) box.add(face_points[at]);
    if (mesh.rules().creases == CreaseMethod::chaikin) box.add(neighbours[at]);  // see face_bounds()
    if (n < 2) continue;
    const VertexMask mask = mesh.rules().vertex(n, {}, mesh.is_cone(v));
    box.add(detail::sum(detail::sum(detail::scaled(point, mask.vertex), neighbours[at], n * mask.edge), sides,
                        quads ? n * mask.face : 0));
  }
  return result;
}

namespace detail {

/// Where masks have negative weights: of patches two splits down, whose neighbourhoods are a third as wide.
template <Scheme S>
std::vector<Box> split_face_bounds(const SubdivisionMesh<S>& mesh) {
  std::vector<Box> result;
  for (const int f : mesh.faces())
    result.push_back(mesh.has_limit(f) ? split_limit_bound(mesh.patch({f, 0}), 2).with_rounding() : Box());
  return result;
}

}  // namespace detail

/// For every face a box that holds its limit, with room for rounding: the hull of its Bezier points if it is regular;
/// else of the boxes of its corners, expanded where refinement may leave the hull
/// (under Chaikin's rule, see hull_expansion.h; there the boxes hold the control points too). O(size), without refining
/// anything, for masks that are convex combinations; else every face is split twice.
template <Scheme S>
std::vector<Box> face_bounds(const SubdivisionMesh<S>& mesh) {
  if (!mesh.table().is_convex()) return detail::split_face_bounds(mesh);
  const std::vector<Box> corners = corner_bounds(mesh);
  std::vector<float> sharpest(corners.size(), 0);
  for (const int e : mesh.edges()) {
    const Mesh::Edge edge = mesh.edge(e);
    for (const int v : {edge.a, edge.b}) {
      float& known = sharpest[static_cast<std::size_t>(v)];
      if (is_semi_sharp(edge.sharpness)) known = std::max(known, edge.sharpness);
    }
  }
  std::optional<RegularBounds<S>> regular;
  if (basis_of(mesh.rules().scheme) == Basis::spline) regular.emplace(mesh);
  std::vector<Box> result;
  for (const int f : mesh.faces()) {
    if (regular && regular->is_regular(f)) {
      result.push_back((*regular)(f));
      continue;
    }
    Box box;
    float sharpness = 0;
    for (const int v : mesh.face(f)) {
      box.add(corners[static_cast<std::size_t>(v)]);
      sharpness = std::max(sharpness, sharpest[static_cast<std::size_t>(v)]);
    }
    result.push_back(box.expanded(hull_expansion(mesh.rules(), sharpness)).with_rounding());
  }
  return result;
}

}  // namespace shaolin
