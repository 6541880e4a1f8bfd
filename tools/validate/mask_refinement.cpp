#include "tools/validate/mask_refinement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/validate/corner_limit.h"

namespace shaolin {
namespace {

/// `Point` is Vec3, or as exact as its numbers are.
template <class Point>
class MaskStep {
 public:
  using Scalar = typename Point::Scalar;

  MaskStep(const TaggedMesh& coarse, const std::vector<Point>& points, const Refined& fine,
           const SubdivisionRules& rules, const SchemeMasks& masks, const VertexWeightsOf<Scalar>& vertex_weights)
      : coarse_(coarse),
        points_(points),
        fine_(fine),
        masks_(masks),
        vertex_weights_(vertex_weights),
        triangular_(rules.triangular()),
        smooth_triangles_(rules.options.GetTriangleSubdivision() == OpenSubdiv::Sdc::Options::TRI_SUB_SMOOTH),
        by_rings_(masks.radius() == 2) {}

  /// The points of the finer mesh; zero where it has none.
  std::vector<Point> run();

 private:
  /// The sum of points times weights.
  struct Sum {
    Point value = Point::Zero();
    void add(const Scalar& weight, const Point& point) { value += weight * point; }
  };

  /// How sharpness sees a vertex: its own and its edges', with the number of those that are sharp.
  struct Tags {
    float vertex;
    std::vector<float> edges;

    long sharp_edges() const {
      return std::count_if(edges.begin(), edges.end(), [](float s) { return s > 0; });
    }
    /// 0 smooth, 1 dart, 2 crease, 3 corner.
    long rule() const { return vertex > 0 ? 3 : std::min(sharp_edges(), 3L); }
  };

  /// A fan of faces around a vertex, from one crease or boundary to the next, or all around.
  struct Fan {
    int vertex;
    bool closed;
    std::vector<int> ends;         ///< the neighbours, counter-clockwise; one more than faces unless closed
    std::vector<Point> diagonals;  ///< per face
    int from;                      ///< where masks count from

    int faces() const { return static_cast<int>(diagonals.size()); }
    int valence() const { return closed ? faces() : 2 * faces(); }
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Point& point(int vertex) const { return points_[at(vertex)]; }
  int other_end(int edge, int vertex) const {
    const auto [a, b] = coarse_.edge_vertices[at(edge)];
    return a == vertex ? b : a;
  }

  int child_of_edge(int edge) const;
  int child_of_face(int face) const;
  float half(int edge, int vertex) const;
  Tags tags(int vertex) const;
  Tags child_tags(int vertex) const;
  Point mean_of(int face) const;
  Point diagonal(int face, int corner) const;
  Fan fan(int face, int corner) const;
  Point by_ring_mask(const Fan& fan, const RingMask& mask) const;
  EdgeMask edge_mask(int edge) const;

  Point face_point(int face) const;
  Point edge_point(int edge) const;
  Point smooth_edge_point(int edge) const;
  Point vertex_point(int vertex) const;
  Point vertex_point_by(long rule, const Tags& tags, bool is_dart, int vertex) const;

  const TaggedMesh& coarse_;
  const std::vector<Point>& points_;
  const Refined& fine_;
  const SchemeMasks& masks_;
  const VertexWeightsOf<Scalar>& vertex_weights_;
  bool triangular_, smooth_triangles_, by_rings_;
  std::vector<Point> face_points_;
};

/// Child i of a face begins at the child of corner i; on the face's own frame it is that child's vertex i, on an
/// n-gon's its vertex 0. The next vertex is the outgoing edge's child.
template <class Point>
int MaskStep<Point>::child_of_edge(int edge) const {
  const int face = coarse_.edge_faces[edge][0], i = coarse_.edge_face_slots[edge][0];
  const auto child = fine_.mesh.face_vertices[fine_.face_children[face][i]];
  const bool regular = coarse_.face_vertices.count(face) == (triangular_ ? 3 : 4);
  return child[regular ? at((i + 1) % static_cast<int>(child.size())) : 1];
}

template <class Point>
int MaskStep<Point>::child_of_face(int face) const {
  const auto child = fine_.mesh.face_vertices[fine_.face_children[face][0]];
  return child[2];
}

template <class Point>
float MaskStep<Point>::half(int edge, int vertex) const {
  const int a = fine_.vertex_child[at(vertex)], b = child_of_edge(edge);
  for (const int e : fine_.mesh.vertex_edges[a]) {
    const auto ends = fine_.mesh.edge_vertices[at(e)];
    if (ends[0] == b || ends[1] == b) return fine_.mesh.edge_sharpness[at(e)];
  }
  return 0;
}

template <class Point>
typename MaskStep<Point>::Tags MaskStep<Point>::tags(int vertex) const {
  Tags result{coarse_.vertex_sharpness[at(vertex)], {}};
  for (const int e : coarse_.vertex_edges[vertex])
    result.edges.push_back(coarse_.is_crease(e) ? osd_infinite : coarse_.edge_sharpness[at(e)]);
  return result;
}

template <class Point>
typename MaskStep<Point>::Tags MaskStep<Point>::child_tags(int vertex) const {
  Tags result{fine_.mesh.vertex_sharpness[at(fine_.vertex_child[at(vertex)])], {}};
  for (const int e : coarse_.vertex_edges[vertex])
    result.edges.push_back(coarse_.is_crease(e) ? osd_infinite : half(e, vertex));
  return result;
}

template <class Point>
Point MaskStep<Point>::mean_of(int face) const {
  Point sum = Point::Zero();
  for (const int v : coarse_.face_vertices[face]) sum += point(v);
  return sum / Scalar(coarse_.face_vertices.count(face));
}

/// The vertex across a quad, or the fourth corner of the parallelogram over a corner's two sides.
template <class Point>
Point MaskStep<Point>::diagonal(int face, int corner) const {
  const auto vertices = coarse_.face_vertices[face];
  if (vertices.size() == 4) return point(vertices[at((corner + 2) % 4)]);
  return point(coarse_.next_vertex(face, corner)) + point(coarse_.previous_vertex(face, corner)) -
         point(vertices[at(corner)]);
}

/// Masks count from the edge that leaves the face's corner.
template <class Point>
typename MaskStep<Point>::Fan MaskStep<Point>::fan(int face, int corner) const {
  Sector around = sector_around(coarse_, face, corner, true);
  Sector cut = sector_around(coarse_, face, corner, false);
  int creases = 0;
  for (int i = 0; i < around.size(); ++i)
    creases += coarse_.is_crease(coarse_.next_edge(around.faces[at(i)], around.corners[at(i)]));
  const int vertex = coarse_.face_vertices[face][at(corner)];
  const bool is_cut = creases >= (coarse_.vertex_sharpness[at(vertex)] >= osd_infinite ? 1 : 2);
  const Sector& sector = around.closed && !is_cut ? around : cut;
  Fan fan{vertex, sector.closed, {}, {}, 0};
  for (int i = 0; i < sector.size(); ++i) {
    const int f = sector.faces[at(i)], c = sector.corners[at(i)];
    if (f == face && c == corner) fan.from = i;
    fan.ends.push_back(coarse_.next_vertex(f, c));
    fan.diagonals.push_back(diagonal(f, c));
  }
  if (!fan.closed) fan.ends.push_back(coarse_.previous_vertex(sector.faces.back(), sector.corners.back()));
  return fan;
}

/// An open fan of k faces is laid out flat, its creases in one line and pi / k between its edges, and mirrored in that
/// line: what the mask weighs beyond it, at an angle of -a, is 2 foot - p for the point p at a, whose foot stands at
/// cos(a) times p's distance on the line.
template <class Point>
Point MaskStep<Point>::by_ring_mask(const Fan& fan, const RingMask& mask) const {
  const int n = fan.valence(), k = fan.faces();
  const Point& centre = point(fan.vertex);
  const auto mirrored = [&](const Point& p, double angle, double distance) -> Point {
    const double along = distance * std::cos(angle);
    const Point& end = point(along > 0 ? fan.ends.front() : fan.ends.back());
    return Scalar(2) * (centre + Scalar(std::abs(along)) * (end - centre)) - p;
  };
  Sum sum;
  sum.add(Scalar(mask.vertex), centre);
  for (int i = 0; i < static_cast<int>(mask.edges.size()); ++i) {
    const int place = (fan.from + i) % n;
    const bool here = fan.closed || place <= k;
    sum.add(Scalar(mask.edges[at(i)]),
            here ? point(fan.ends[at(place)])
                 : mirrored(point(fan.ends[at(n - place)]), (n - place) * std::numbers::pi / k, 1));
  }
  for (int i = 0; i < static_cast<int>(mask.diagonals.size()); ++i) {
    const int place = (fan.from + i) % n;
    const bool here = fan.closed || place < k;
    sum.add(Scalar(mask.diagonals[at(i)]),
            here ? fan.diagonals[at(place)]
                 : mirrored(fan.diagonals[at(n - 1 - place)], (n - place - 0.5) * std::numbers::pi / k,
                            std::numbers::sqrt2));
  }
  return sum.value;
}

template <class Point>
Point MaskStep<Point>::face_point(int face) const {
  const int size = coarse_.face_vertices.count(face);
  if (!by_rings_ || size != 4) return mean_of(face);
  Point sum = Point::Zero();
  for (int c = 0; c < 4; ++c) {
    const int vertex = coarse_.face_vertices[face][at(c)];
    const Fan around = fan(face, c);
    const bool has_mask = around.valence() >= 3;
    sum += has_mask ? by_ring_mask(around, masks_.face_corner(around.valence())) : Point(point(vertex) / Scalar(4));
  }
  return sum;
}

template <class Point>
EdgeMask MaskStep<Point>::edge_mask(int edge) const {
  const auto faces = coarse_.edge_faces[edge];
  const auto triangles =
      std::count_if(faces.begin(), faces.end(), [&](int face) { return coarse_.face_vertices.count(face) == 3; });
  const bool beside_triangles = !triangular_ && smooth_triangles_ && triangles > 0;
  return beside_triangles ? masks_.triangle_edge(static_cast<int>(triangles)) : masks_.smooth_edge();
}

template <class Point>
Point MaskStep<Point>::smooth_edge_point(int edge) const {
  const auto ends = coarse_.edge_vertices[at(edge)];
  const Point middle = (point(ends[0]) + point(ends[1])) / Scalar(2);
  if (!by_rings_) {
    const auto faces = coarse_.edge_faces[edge];
    const auto corners = coarse_.edge_face_slots[edge];
    Point sides = Point::Zero();
    for (std::size_t i = 0; i < 2; ++i)
      sides += triangular_ ? point(coarse_.previous_vertex(faces[i], corners[i])) : face_points_[at(faces[i])];
    const EdgeMask mask = edge_mask(edge);
    return Scalar(mask.end * 2) * middle + Scalar(mask.side) * sides;
  }
  std::vector<Fan> fans;  // of either end, each seen from the face that the edge leads there
  for (int i = 0; i < 2; ++i)
    fans.push_back(fan(coarse_.edge_faces[edge][at(i)], coarse_.edge_face_slots[edge][at(i)]));
  if (std::min(fans[0].valence(), fans[1].valence()) < 3) return middle;
  return by_ring_mask(fans[0], masks_.edge_end(fans[0].valence(), fans[1].valence())) +
         by_ring_mask(fans[1], masks_.edge_end(fans[1].valence(), fans[0].valence()));
}

template <class Point>
Point MaskStep<Point>::edge_point(int edge) const {
  const auto [a, b] = coarse_.edge_vertices[at(edge)];
  const Point middle = (point(a) + point(b)) / Scalar(2);
  const float sharpness = coarse_.edge_sharpness[at(edge)];
  if (coarse_.is_crease(edge) || (half(edge, a) > 0 && half(edge, b) > 0)) return middle;
  if (sharpness <= 0) return smooth_edge_point(edge);
  return Scalar(sharpness) * middle + (Scalar(1) - Scalar(sharpness)) * smooth_edge_point(edge);
}

template <class Point>
Point MaskStep<Point>::vertex_point_by(long rule, const Tags& tags, bool is_dart, int vertex) const {
  if (rule == 3) return point(vertex);
  const auto edges = coarse_.vertex_edges[vertex];
  Sum sum;
  if (rule == 2) {
    const CreaseMask crease = masks_.crease();
    sum.add(Scalar(crease.vertex), point(vertex));
    for (std::size_t i = 0; i < edges.size(); ++i)
      if (tags.edges[i] > 0) sum.add(Scalar(crease.edge), point(other_end(edges[i], vertex)));
    return sum.value;
  }
  const int n = static_cast<int>(edges.size());
  const RingRule ring_rule = is_dart                           ? RingRule::dart
                             : coarse_.vertex_cone[at(vertex)] ? RingRule::cone
                                                               : RingRule::smooth;
  const VertexWeights<Scalar> mask = vertex_weights_(n, ring_rule);
  sum.add(mask.vertex, point(vertex));
  for (const int edge : edges) sum.add(mask.edge, point(other_end(edge, vertex)));
  if (mask.face != 0)
    for (const int face : coarse_.vertex_faces[vertex]) sum.add(mask.face, face_points_[at(face)]);
  return sum.value;
}

/// Both levels' rules; where they differ, shared by the mean of the sharpness that ends here.
template <class Point>
Point MaskStep<Point>::vertex_point(int vertex) const {
  if (coarse_.vertex_non_manifold[at(vertex)]) return point(vertex);
  const Tags now = tags(vertex), next = child_tags(vertex);
  const long rule = now.rule(), child = rule < 2 ? rule : next.rule();
  const bool is_dart = rule == 1 || child == 1;
  const Point by_parent = vertex_point_by(rule, now, is_dart, vertex);
  if (rule == child) return by_parent;
  float sum = 0;
  int count = 0;
  const auto ends_here = [&](float before, float after) {
    if (before > 0 && after <= 0) sum += before, ++count;
  };
  ends_here(now.vertex, next.vertex);
  for (std::size_t i = 0; i < now.edges.size(); ++i) ends_here(now.edges[i], next.edges[i]);
  const Scalar share(std::min(1.0f, sum / static_cast<float>(count)));
  return share * by_parent + (Scalar(1) - share) * vertex_point_by(child, next, is_dart, vertex);
}

template <class Point>
std::vector<Point> MaskStep<Point>::run() {
  std::vector<Point> points(fine_.mesh.points.size(), Point::Zero());
  for (int f = 0; f < coarse_.face_count(); ++f) {
    face_points_.push_back(face_point(f));
    if (!triangular_) points[at(child_of_face(f))] = face_points_.back();
  }
  for (int e = 0; e < coarse_.edge_count(); ++e) points[at(child_of_edge(e))] = edge_point(e);
  for (int v = 0; v < coarse_.vertex_count(); ++v)
    if (coarse_.vertex_faces.count(v) > 0) points[at(fine_.vertex_child[at(v)])] = vertex_point(v);
  return points;
}

}  // namespace

VertexMask vertex_mask(const SchemeMasks& masks, int n, RingRule rule) {
  if (rule == RingRule::dart) return masks.dart_vertex(n);
  return rule == RingRule::cone ? masks.cone_vertex(n) : masks.smooth_vertex(n);
}

Refined refine(const TaggedMesh& mesh, const SubdivisionRules& rules, const SchemeMasks& masks) {
  Refined result = refine(mesh, rules);
  const VertexWeightsOf<double> weights = [&](int n, RingRule rule) -> VertexWeights<double> {
    const VertexMask mask = vertex_mask(masks, n, rule);
    return {mask.vertex, mask.edge, mask.face};
  };
  result.mesh.points = MaskStep<Vec3>(mesh, mesh.points, result, rules, masks, weights).run();
  return result;
}

std::vector<QuadVec3> refine_points(const TaggedMesh& coarse, const std::vector<QuadVec3>& points, const Refined& fine,
                                    const SubdivisionRules& rules, const SchemeMasks& masks,
                                    const VertexWeightsOf<Quad>& vertex_weights) {
  return MaskStep<QuadVec3>(coarse, points, fine, rules, masks, vertex_weights).run();
}

}  // namespace shaolin
