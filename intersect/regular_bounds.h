#pragma once
/// Boxes for faces whose limit is one polynomial: the hulls of their Bezier points.
#include <array>
#include <cstddef>
#include <optional>

#include "../schemes/subdivision_mesh.h"
#include "box.h"

namespace shaolin {

namespace detail {

/// The place of a corner and of the three vertices beyond it among the points of a bicubic B-spline, 4 j + i, for
/// corners in order; beyond the first they are, counter-clockwise, left of it, on the diagonal, and below it.
inline constexpr std::array<std::array<std::size_t, 4>, 4> spline_places{
    {{5, 4, 0, 1}, {6, 2, 3, 7}, {10, 11, 15, 14}, {9, 13, 12, 8}}};

}  // namespace detail

/// The spline's points around a face, in the order of RegularPatch::from_spline(), found by steps from half-edge to
/// half-edge, without a patch; empty if the face is not regular. It is regular here if all faces around its corners are
/// of the scheme's kind, closed rings of four (quads) or six (triangles), and no vertex or edge of a corner is sharp.
template <Scheme S>
std::optional<std::array<Vec3, RegularPatch<S::face_kind>::spline_size>> spline_points(const SubdivisionMesh<S>& mesh,
                                                                                       int face) {
  constexpr bool quads = S::face_kind == FaceKind::quad;
  constexpr int corners = quads ? 4 : 3, valence = quads ? 4 : 6;
  const HalfEdges& half_edges = mesh.half_edges();
  if (mesh.face_size(face) != corners) return {};
  std::array<Vec3, RegularPatch<S::face_kind>::spline_size> points;
  for (int k = 0; k < corners; ++k) {
    const int corner = half_edges.first(face) + k, vertex = half_edges.from(corner);
    if (!mesh.is_plain(vertex)) return {};
    std::array<int, valence> ring;  // corners around the vertex, counter-clockwise from the face's own
    int at = corner;
    for (int& own : ring) {
      if (at < 0 || (at == corner && &own != ring.data()) || mesh.face_size(half_edges.face(at)) != corners) return {};
      own = at;
      at = half_edges.counter_clockwise(at);
    }
    if (at != corner) return {};
    const auto place = static_cast<std::size_t>(k);
    const auto end = [&](int side) -> const Vec3& { return mesh.point(half_edges.to(side)); };
    if constexpr (quads) {
      const auto& [own, left, diagonal, below] = detail::spline_places[place];
      points[own] = mesh.point(vertex);
      points[left] = end(ring[2]);
      points[diagonal] = end(half_edges.next(ring[2]));
      points[below] = end(ring[3]);
    } else {
      points[place] = mesh.point(vertex);
      points[3 + place] = end(ring[5]);  // across the side that leaves the corner
      points[6 + 2 * place] = end(ring[3]);
      points[7 + 2 * place] = end(ring[4]);
    }
  }
  return points;
}

/// A box that holds the limit of a regular face, with room for the rounding of its control points; empty if the face is
/// not regular. O(1).
template <Scheme S>
std::optional<Box> regular_bound(const SubdivisionMesh<S>& mesh, int face) {
  const auto points = spline_points(mesh, face);
  if (!points) return {};
  return hull_of(RegularPatch<S::face_kind>::from_spline(*points).b).grown(hull_of(*points).rounding());
}

}  // namespace shaolin
