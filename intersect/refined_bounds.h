#pragma once
/// Boxes of the points that one refinement step makes, without the step.
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "../schemes/point_rules.h"
#include "../schemes/subdivision_mesh.h"
#include "box.h"

namespace shaolin {

namespace detail {

/// A face that is not to be taken for what its size says.
inline bool repeats_vertex(std::span<const int> face) {
  for (std::size_t i = 1; i < face.size(); ++i) {
    const auto before = face.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(face.begin(), before, face[i]) != before) return true;
  }
  return false;
}

}  // namespace detail

/// The points that one refinement step makes, without walking rings: sums over the faces at a vertex and at an edge say
/// what the smooth rules make, sharp edges at a vertex what a crease does. Where more than one rule may have a say
/// (where sharpness ends, or a corner's), points of all of them are in the box; where a face repeats a vertex, all that
/// is around. For schemes whose masks are not negative, and not for Chaikin's rule.
template <Scheme S>
class RefinedBounds {
  static constexpr bool quads = S::face_kind == FaceKind::quad;

 public:
  /// O(size).
  explicit RefinedBounds(const SubdivisionMesh<S>& mesh);

  /// A box of all new points around a vertex: of itself, its edges and its faces.
  const Box& around(int vertex) const { return at(vertex).around; }

  /// A box of the new points of a face: of its vertices and edges, and its own.
  Box of(int face) const;

  /// Scalar data that are 0 at the vertices of a new face and 1 elsewhere have limits up to this on the face, see
  /// find_outside_share(). So its limit lies in a box of its vertices, moved by this share of the way to a box of the
  /// points around them.
  double outside_share() const { return outside_share_; }

 private:
  struct Vertex {
    Box old;     ///< what is around: itself, its neighbours and the new face points
    Box point;   ///< of the new point
    Box around;  ///< see around()
    Box crease_ends;
    Vec3 sum_of_neighbours = Vec3::Zero(), sum_of_faces = Vec3::Zero();  ///< the former each twice
    int faces = 0, edges = 0, sharp_edges = 0, lasting_edges = 0;        ///< sharp now, and after this step
    bool is_odd = false;                                                 ///< a face repeats a vertex
  };
  struct Edge {
    Vec3 across = Vec3::Zero();  ///< the sum of new face points, or of opposite vertices, on both sides
    int faces = 0;
    Box point;
  };

  Vertex& at(int vertex) { return vertices_[static_cast<std::size_t>(vertex)]; }
  const Vertex& at(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }
  Edge& edge(int side) { return edges_[static_cast<std::size_t>(side)]; }

  void gather();
  void bound_vertex(int v);
  void bound_edge(int e);
  double find_outside_share() const;

  const SubdivisionMesh<S>& mesh_;
  std::vector<EdgeMask> edge_masks_;  ///< all that differ
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  double outside_share_ = 1;
};

template <Scheme S>
RefinedBounds<S>::RefinedBounds(const SubdivisionMesh<S>& mesh)
    : mesh_(mesh),
      vertices_(static_cast<std::size_t>(mesh.vertex_count())),
      edges_(static_cast<std::size_t>(mesh.edge_count())) {
  for (const int triangles : {0, 1, 2}) {
    const EdgeMask mask = mesh.rules().edge(triangles);
    const auto is_same = [&](const EdgeMask& known) { return known.end == mask.end && known.side == mask.side; };
    if (std::none_of(edge_masks_.begin(), edge_masks_.end(), is_same)) edge_masks_.push_back(mask);
  }
  gather();
  for (const int v : mesh.vertices()) bound_vertex(v);
  for (const int e : mesh.edges()) bound_edge(e);
  outside_share_ = find_outside_share();
}

template <Scheme S>
void RefinedBounds<S>::gather() {
  for (const int f : mesh_.faces()) {
    const FaceSides face = mesh_.face_sides(f);
    const std::span<const int> v = mesh_.face(f);
    const int n = face.size();
    const Vec3 middle = face_point({mesh_.points().data(), v.data(), n});
    const bool is_odd = detail::repeats_vertex(v);
    for (int i = 0; i < n; ++i) {
      Vertex& vertex = at(face.vertex(i));
      const Vec3 &next = mesh_.point(face.vertex(i + 1 == n ? 0 : i + 1)),
                 &last = mesh_.point(face.vertex(i == 0 ? n - 1 : i - 1));
      vertex.old.add(next);
      vertex.old.add(last);
      vertex.sum_of_neighbours += next + last;
      if (quads) {
        vertex.old.add(middle);
        vertex.around.add(middle);
        vertex.sum_of_faces += middle;
      }
      vertex.is_odd |= is_odd;
      ++vertex.faces;
      if (face.side(i) >= mesh_.edge_count()) continue;
      Edge& side = edge(face.side(i));
      side.across += quads ? middle : last;
      ++side.faces;
    }
  }
  for (const int e : mesh_.edges()) {
    const Mesh::Edge edge = mesh_.edge(e);
    for (const auto& [from, to] : {std::pair(edge.a, edge.b), std::pair(edge.b, edge.a)}) {
      Vertex& vertex = at(from);
      ++vertex.edges;
      if (!is_sharp(edge.sharpness)) continue;
      ++vertex.sharp_edges;
      vertex.lasting_edges += edge.sharpness > 1;
      vertex.crease_ends.add(mesh_.point(to));
    }
  }
}

template <Scheme S>
void RefinedBounds<S>::bound_vertex(int v) {
  const Rules<S>& rules = mesh_.rules();
  const Vec3& point = mesh_.point(v);
  Vertex& vertex = at(v);
  vertex.old.add(point);
  const int n = vertex.faces;
  const float sharpness = mesh_.vertex_sharpness(v);
  const bool is_lasting = vertex.lasting_edges > 1 || sharpness > 1;  // no smooth rule has a say
  const bool is_ring = vertex.edges == n && n > 1;
  if (vertex.is_odd || (!is_lasting && !is_ring)) {
    vertex.point = vertex.old;
  } else {
    if (is_sharp(sharpness) || vertex.sharp_edges > 2) vertex.point.add(point);
    if (vertex.sharp_edges > 1) {
      // (Of two neighbours, the box's corners sum to their sum.)
      const CreaseMask mask = rules.crease();
      const Box& ends = vertex.crease_ends;
      const Vec3 own = mask.vertex * point, sum = mask.edge * (ends.lower + ends.upper);
      if (vertex.sharp_edges == 2)
        vertex.point.add(Vec3(own + sum));
      else
        vertex.point.add(Box{own + 2 * mask.edge * ends.lower, own + 2 * mask.edge * ends.upper});
    }
    const auto add_smooth = [&](const VertexMask& mask) {
      vertex.point.add(
          Vec3(mask.vertex * point + 0.5 * mask.edge * vertex.sum_of_neighbours + mask.face * vertex.sum_of_faces));
    };
    constexpr VertexTransition dart{.parent = VertexRule::dart};
    if (!is_lasting) add_smooth(rules.vertex(n, {}, mesh_.is_cone(v)));
    if (!is_lasting && vertex.sharp_edges > 0) add_smooth(rules.vertex(n, dart, false));
  }
  vertex.around.add(vertex.point);
  if (vertex.is_odd) vertex.around.add(vertex.old);
}

template <Scheme S>
void RefinedBounds<S>::bound_edge(int e) {
  const Mesh::Edge edge = mesh_.edge(e);
  Edge& side = this->edge(e);
  const Vec3 ends = mesh_.point(edge.a) + mesh_.point(edge.b);
  if (is_sharp(edge.sharpness) || side.faces != 2) side.point.add(Vec3(0.5 * ends));
  if (!(edge.sharpness >= 1))
    for (const EdgeMask& mask : edge_masks_)
      side.point.add(side.faces == 2 ? Vec3(mask.end * ends + mask.side * side.across) : side.across);
  for (const int v : {edge.a, edge.b}) {
    at(v).around.add(side.point);
    if (at(v).is_odd) side.point.add(at(v).old);
  }
}

template <Scheme S>
Box RefinedBounds<S>::of(int face) const {
  const FaceSides sides = mesh_.face_sides(face);
  Box box;
  if (quads) box.add(face_point({mesh_.points().data(), mesh_.face(face).data(), sides.size()}));
  for (int i = 0; i < sides.size(); ++i) {
    box.add(at(sides.vertex(i)).point);
    if (sides.side(i) < mesh_.edge_count()) box.add(edges_[static_cast<std::size_t>(sides.side(i))].point);
  }
  return box;
}

/// Let the data be at most a at the vertices of a face, b at those that share an edge with one of them, and c at all
/// others around. The rules then bound them at the vertices of a child and around it: where it keeps the vertex v, two
/// of v's spokes and one of its face points are the face's own; of the other face points around v two have a spoke of
/// the face, and across an edge lie two of its vertices and two that share edges with them. The three meet, at what no
/// limit on the face is above.
template <Scheme S>
double RefinedBounds<S>::find_outside_share() const {
  const Rules<S>& rules = mesh_.rules();
  // Past the first step all faces are of the scheme's kind, and there are vertices in the middle of those that are not.
  const EdgeMask edge = edge_masks_.front();
  const CreaseMask crease = rules.crease();
  std::vector<std::pair<int, VertexMask>> vertices{{quads ? 4 : 6, rules.vertex(quads ? 4 : 6, {}, false)}};
  std::vector<bool> is_known;
  const auto see = [&](int n) {
    if (n < 2 || is_known[static_cast<std::size_t>(n)]) return;
    is_known[static_cast<std::size_t>(n)] = true;
    vertices.emplace_back(n, rules.vertex(n, {}, false));
  };
  int most = 0;
  for (const Vertex& vertex : vertices_) most = std::max(most, vertex.faces);
  for (const int f : mesh_.faces()) most = std::max(most, mesh_.face_size(f));
  is_known.resize(static_cast<std::size_t>(most) + 1);
  for (const int f : mesh_.faces()) see(mesh_.face_size(f));
  for (const int v : mesh_.vertices()) {
    const int n = at(v).faces;
    see(n);
    constexpr VertexTransition dart{.parent = VertexRule::dart};
    if (n > 1 && mesh_.is_cone(v)) vertices.emplace_back(n, rules.vertex(n, {}, true));
    if (n > 1 && at(v).sharp_edges > 0) vertices.emplace_back(n, rules.vertex(n, dart, false));
  }

  double a = 0, b = 1, c = 1;
  constexpr double close = 1e-3;
  for (int step = 0; step < 100 && std::max(b, c) - a > close; ++step) {
    const double across = quads ? 0.5 * (a + b) : b;  // a face point, or of triangles the vertex
    const double beside = 0.25 * (2 * a + b + c), around = quads ? 0.25 * (a + 2 * b + c) : b;
    double own = std::max(crease.vertex * a + 2 * crease.edge * b, 2 * edge.end * a + edge.side * (a + across));
    for (const auto& [n, mask] : vertices)
      own = std::max(own, mask.vertex * a + mask.edge * (2 * a + (n - 2) * b) +
                              mask.face * (a + std::min(2, n - 1) * beside + std::max(0, n - 3) * around));
    const double spoke = std::max(0.5 * (a + b), edge.end * (a + b) + 2 * edge.side * around);
    a = own;
    b = quads ? std::max(spoke, across) : spoke;
    c = std::max(b, around);
  }
  return std::min(1.0, std::max({a, b, c}) + 1e-12);  // of sums that round
}

}  // namespace shaolin
