#pragma once
/// Boxes for faces whose limit is one polynomial: the hulls of their Bezier points.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../schemes/subdivision_mesh.h"
#include "box.h"

namespace shaolin {

/// The Bezier points of all regular faces without a patch of any: they are sums over the faces at a vertex and at an
/// edge, made in two passes over the faces. A face is regular here if all faces around its corners are of the scheme's
/// kind, closed rings of four (Catmull-Clark) or six (Loop), and no vertex or edge of a corner is sharp.
///
/// With I(f, k) for the inner point of face f nearest to its corner k (of quads p0 p1 p2 p3: (4 p0 + 2 (p1 + p3) + p2)
/// / 9; of triangles see BezierTriangle::from_spline()), and I for the sum over the faces at hand:
///   quads:      edge points I / 2, corners I / 4, as the bicubic is a tensor product of (1, 4, 1)/6 and (4, 2)/6;
///   triangles:  middles of edges (2 (a + b) + l + r) / 6 for the vertices l and r across the edge; edge points I -
///               middle, since two quartics that meet smoothly have I = edge point + middle; corners (6 a + sum of
///               neighbours) / 12.
template <Scheme S>
class RegularBounds {
  static constexpr bool quads = S::face_kind == FaceKind::quad;
  static constexpr int corners = quads ? 4 : 3;

 public:
  /// O(size).
  explicit RegularBounds(const SubdivisionMesh<S>& mesh);

  bool is_regular(int face) const;

  /// A box that holds the limit of a regular face, with room for the rounding of its control points.
  Box operator()(int face) const;

 private:
  struct Vertex {
    Vec3 sum = Vec3::Zero();  ///< quads: of inner points; triangles: of neighbours, each twice
    double largest = 0;       ///< coordinate around it
    int faces = 0;
    bool is_regular = true;
  };
  struct Edge {
    std::array<Vec3, 2> inner{Vec3::Zero(), Vec3::Zero()};  ///< sums by end
    Vec3 across = Vec3::Zero();                             ///< triangles: the sum of the vertices across
    int a = -1;                                             ///< its first end
    int faces = 0;
  };

  Vertex& vertex(int v) { return vertices_[static_cast<std::size_t>(v)]; }
  const Vertex& vertex(int v) const { return vertices_[static_cast<std::size_t>(v)]; }
  Edge& edge(int e) { return edges_[static_cast<std::size_t>(e)]; }
  const Edge& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }

  void add_inner(const FaceSides& face);
  /// Of a face seen from a corner, the inner point next to that.
  Vec3 inner(const FaceSides& face) const;

  const SubdivisionMesh<S>& mesh_;
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
};

template <Scheme S>
RegularBounds<S>::RegularBounds(const SubdivisionMesh<S>& mesh)
    : mesh_(mesh),
      vertices_(static_cast<std::size_t>(mesh.vertex_count())),
      edges_(static_cast<std::size_t>(mesh.edge_count())) {
  for (const int v : mesh.vertices())
    if (is_sharp(mesh.vertex_sharpness(v)) || mesh.is_cone(v)) vertex(v).is_regular = false;
  for (const int e : mesh.edges()) {
    const Mesh::Edge ends = mesh.edge(e);
    edge(e).a = ends.a;
    if (is_sharp(ends.sharpness)) vertex(ends.a).is_regular = vertex(ends.b).is_regular = false;
  }
  for (const int f : mesh.faces()) {
    const FaceSides face = mesh.face_sides(f);
    bool is_plain = face.size() == corners;
    double largest = 0;
    for (int k = 0; k < face.size(); ++k) {
      is_plain &= face.side(k) < mesh.edge_count();
      largest = std::max(largest, mesh.point(face.vertex(k)).cwiseAbs().maxCoeff());
    }
    for (int k = 0; k < face.size(); ++k) {
      Vertex& at = vertex(face.vertex(k));
      at.is_regular &= is_plain;
      at.largest = std::max(at.largest, largest);
      ++at.faces;
      if (!is_plain) continue;
      Edge& side = edge(face.side(k));
      ++side.faces;
      if constexpr (!quads) {
        const FaceSides seen = face.turned(k);
        at.sum += mesh.point(seen.vertex(1)) + mesh.point(seen.vertex(2));
        side.across += mesh.point(seen.vertex(2));
      }
    }
  }
  for (const int e : mesh.edges())
    if (edge(e).faces != 2) {
      const Mesh::Edge ends = mesh.edge(e);
      vertex(ends.a).is_regular = vertex(ends.b).is_regular = false;
    }
  for (const int v : mesh.vertices()) vertex(v).is_regular &= vertex(v).faces == (quads ? 4 : 6);
  for (const int f : mesh.faces()) {
    const FaceSides face = mesh.face_sides(f);
    if (face.size() != corners) continue;
    for (int k = 0; k < corners; ++k) add_inner(face.turned(k));
  }
}

/// Of the face that is seen from a corner: its inner point next to that, to the edges that meet there.
template <Scheme S>
void RegularBounds<S>::add_inner(const FaceSides& face) {
  const Vec3 point = inner(face);
  for (const int side : {face.side(0), face.side(corners - 1)})
    if (side < mesh_.edge_count()) edge(side).inner[edge(side).a == face.vertex(0) ? 0 : 1] += point;
  if (quads) vertex(face.vertex(0)).sum += point;
}

template <Scheme S>
Vec3 RegularBounds<S>::inner(const FaceSides& face) const {
  const auto point = [&](int k) -> const Vec3& { return mesh_.point(face.vertex(k)); };
  if constexpr (quads) {
    return (4 * point(0) + 2 * (point(1) + point(3)) + point(2)) / 9;
  } else {
    const auto across = [&](int side, int own) -> Vec3 { return edge(face.side(side)).across - point(own); };
    return (10 * point(0) + 6 * (point(1) + point(2)) + (across(0, 2) + across(2, 1))) / 24;
  }
}

template <Scheme S>
bool RegularBounds<S>::is_regular(int face) const {
  const std::span<const int> v = mesh_.face(face);
  return static_cast<int>(v.size()) == corners &&
         std::all_of(v.begin(), v.end(), [&](int at) { return vertex(at).is_regular; });
}

template <Scheme S>
Box RegularBounds<S>::operator()(int face) const {
  Box box;
  double largest = 0;
  for (int k = 0; k < corners; ++k) {
    const FaceSides seen = mesh_.face_sides(face).turned(k);
    const Vertex& at = vertex(seen.vertex(0));
    const Edge& side = edge(seen.side(0));
    largest = std::max(largest, at.largest);
    box.add(inner(seen));
    if constexpr (quads) {
      box.add(Vec3(at.sum / 4));
      for (const Vec3& sum : side.inner) box.add(Vec3(sum / 2));
    } else {
      const Vec3 &here = mesh_.point(seen.vertex(0)), &next = mesh_.point(seen.vertex(1));
      const Vec3 middle = (2 * (here + next) + side.across) / 6;
      box.add(Vec3((6 * here + at.sum / 2) / 12));
      box.add(middle);
      for (const Vec3& sum : side.inner) box.add(Vec3(sum - middle));
    }
  }
  return box.grown(Box{Vec3::Constant(-largest), Vec3::Constant(largest)}.rounding());
}

}  // namespace shaolin
