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

/// The points that one refinement step makes around vertices and faces, by steps from half-edge to half-edge. Where
/// more than one rule may have a say (where sharpness ends, or a corner's), points of all of them are in the box. For
/// schemes whose masks are not negative, not for Chaikin's rule, and not beside faces that repeat a vertex.
template <Scheme S>
class RefinedBounds {
  static constexpr bool quads = S::face_kind == FaceKind::quad;

 public:
  /// O(size).
  explicit RefinedBounds(const SubdivisionMesh<S>& mesh);

  /// A box that holds the limit of a face: of the new points of its vertices and edges and its own, moved by
  /// outside_share() of the way to a box of the new points around its vertices. O(its valences), once for each vertex.
  Box operator()(int face);

  /// Scalar data that are 0 at the vertices of a new face and 1 elsewhere have limits up to this on the face, see
  /// find_outside_share(). So its limit lies in a box of its vertices, moved by this share of the way to a box of the
  /// points around them.
  double outside_share() const { return outside_share_; }

 private:
  /// Boxes of a vertex's new point, and of all new points around: of itself, its edges and its faces.
  struct Vertex {
    Box point, around;
  };

  const Vertex& vertex(int corner);
  Vertex bound_vertex(int corner);
  Box edge_point(int side) const;
  /// The new point of a face, or of triangles the vertex across a side.
  Vec3 across(int side) const;
  double find_outside_share() const;

  const SubdivisionMesh<S>& mesh_;
  const HalfEdges& half_edges_;
  std::vector<EdgeMask> edge_masks_;  ///< all that differ
  std::vector<int> numbers_;          ///< of vertices that are known; -1 for others
  std::vector<Vertex> vertices_;
  double outside_share_ = 1;
};

template <Scheme S>
RefinedBounds<S>::RefinedBounds(const SubdivisionMesh<S>& mesh)
    : mesh_(mesh), half_edges_(mesh.half_edges()), numbers_(static_cast<std::size_t>(mesh.vertex_count()), -1) {
  for (const int triangles : {0, 1, 2}) {
    const EdgeMask mask = mesh.rules().edge(triangles);
    const auto is_same = [&](const EdgeMask& known) { return known.end == mask.end && known.side == mask.side; };
    if (std::none_of(edge_masks_.begin(), edge_masks_.end(), is_same)) edge_masks_.push_back(mask);
  }
  outside_share_ = find_outside_share();
}

template <Scheme S>
Box RefinedBounds<S>::operator()(int face) {
  const int first = half_edges_.first(face), size = mesh_.face_size(face);
  Box own, around;
  if (quads) own.add(across(first));
  for (int side = first; side < first + size; ++side) {
    own.add(vertex(side).point);
    own.add(edge_point(side));
    around.add(vertex(side).around);
  }
  const double share = outside_share_;
  return {own.lower.cwiseMin((1 - share) * own.lower + share * around.lower),
          own.upper.cwiseMax((1 - share) * own.upper + share * around.upper)};
}

template <Scheme S>
auto RefinedBounds<S>::vertex(int corner) -> const Vertex& {
  int& number = numbers_[static_cast<std::size_t>(half_edges_.from(corner))];
  if (number < 0) {
    number = static_cast<int>(vertices_.size());
    vertices_.push_back(bound_vertex(corner));
  }
  return vertices_[static_cast<std::size_t>(number)];
}

template <Scheme S>
Vec3 RefinedBounds<S>::across(int side) const {
  if (!quads) return mesh_.point(half_edges_.from(half_edges_.previous(side)));
  const std::span<const int> face = mesh_.face(half_edges_.face(side));
  return face_point({mesh_.points().data(), face.data(), static_cast<int>(face.size())});
}

template <Scheme S>
auto RefinedBounds<S>::bound_vertex(int corner) -> Vertex {
  const Rules<S>& rules = mesh_.rules();
  const int v = half_edges_.from(corner);
  const Vec3& point = mesh_.point(v);

  Box old, crease_ends;  // of itself, its neighbours and the new points of its faces; of sharp edges' ends
  Vec3 sum_of_neighbours = Vec3::Zero(), sum_of_faces = Vec3::Zero();
  int edges = 0, faces = 0, sharp_edges = 0, lasting_edges = 0;  // sharp now, and after this step
  Vertex result;
  old.add(point);
  const auto add_edge = [&](int side, int end) {
    old.add(mesh_.point(end));
    sum_of_neighbours += mesh_.point(end);
    ++edges;
    result.around.add(edge_point(side));
    if (!mesh_.has_sharp_edge(v)) return;
    const float sharpness = mesh_.edge(half_edges_.edge(side)).sharpness;
    if (!is_sharp(sharpness)) return;
    ++sharp_edges;
    lasting_edges += sharpness > 1;
    crease_ends.add(mesh_.point(end));
  };
  int first = corner;
  for (int at = half_edges_.clockwise(corner); at >= 0 && at != corner; at = half_edges_.clockwise(at)) first = at;
  int at = first;
  do {
    ++faces;
    if (quads) {
      const Vec3 middle = across(at);
      old.add(middle);
      result.around.add(middle);
      sum_of_faces += middle;
    }
    add_edge(at, half_edges_.to(at));
    const int last = half_edges_.previous(at);
    at = half_edges_.counter_clockwise(at);
    if (at < 0) add_edge(last, half_edges_.from(last));
  } while (at >= 0 && at != first);

  const float sharpness = mesh_.vertex_sharpness(v);
  const bool is_lasting = lasting_edges > 1 || sharpness > 1;  // no smooth rule has a say
  const bool is_ring = edges == faces && faces > 1;
  Box& box = result.point;
  if (!is_lasting && !is_ring) {
    box = old;
  } else {
    if (is_sharp(sharpness) || sharp_edges > 2) box.add(point);
    if (sharp_edges > 1) {
      // (Of two neighbours, the box's corners sum to their sum.)
      const CreaseMask mask = rules.crease();
      const Vec3 own = mask.vertex * point, sum = mask.edge * (crease_ends.lower + crease_ends.upper);
      if (sharp_edges == 2)
        box.add(Vec3(own + sum));
      else
        box.add(Box{own + 2 * mask.edge * crease_ends.lower, own + 2 * mask.edge * crease_ends.upper});
    }
    const auto add_smooth = [&](const VertexMask& mask) {
      box.add(Vec3(mask.vertex * point + mask.edge * sum_of_neighbours + mask.face * sum_of_faces));
    };
    constexpr VertexTransition dart{.parent = VertexRule::dart};
    if (!is_lasting) add_smooth(rules.vertex(faces, {}, mesh_.is_cone(v)));
    if (!is_lasting && sharp_edges > 0) add_smooth(rules.vertex(faces, dart, false));
  }
  result.around.add(box);
  return result;
}

template <Scheme S>
Box RefinedBounds<S>::edge_point(int side) const {
  const int twin = half_edges_.twin(side);
  const Mesh::Edge edge = mesh_.edge(std::min(side, twin));
  const Vec3 ends = mesh_.point(edge.a) + mesh_.point(edge.b);
  Box box;
  if (is_sharp(edge.sharpness) || twin == side) box.add(Vec3(0.5 * ends));
  if (edge.sharpness >= 1) return box;
  const Vec3 sides = twin == side ? across(side) : across(side) + across(twin);
  for (const EdgeMask& mask : edge_masks_) box.add(twin == side ? sides : Vec3(mask.end * ends + mask.side * sides));
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
  std::vector<int> faces_at(static_cast<std::size_t>(mesh_.vertex_count()), 0);
  int most = 0;
  for (const int f : mesh_.faces()) {
    for (const int v : mesh_.face(f)) most = std::max(most, ++faces_at[static_cast<std::size_t>(v)]);
    most = std::max(most, mesh_.face_size(f));
  }
  is_known.resize(static_cast<std::size_t>(most) + 1);
  for (const int f : mesh_.faces()) see(mesh_.face_size(f));
  for (const int v : mesh_.vertices()) {
    const int n = faces_at[static_cast<std::size_t>(v)];
    see(n);
    constexpr VertexTransition dart{.parent = VertexRule::dart};
    if (n > 1 && mesh_.is_cone(v)) vertices.emplace_back(n, rules.vertex(n, {}, true));
    if (n > 1 && mesh_.has_sharp_edge(v)) vertices.emplace_back(n, rules.vertex(n, dart, false));
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
