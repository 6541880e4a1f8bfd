#pragma once
/// Subdivision meshes: global and local refinement, parent and child, limit points and normals, chord normals.
#include <cassert>
#include <memory>
#include <mutex>
#include <type_traits>

#include "configuration.h"
#include "evaluate.h"
#include "mesh.h"
#include "patch.h"
#include "plain_face.h"

namespace shaolin {

/// A triangle or quad mesh under a scheme. refine() makes the whole next level; patch() and Patch::child() refine one
/// face and leave its neighbours coarse. Both apply the same masks and sharpness rules (point_rules.h, sharpness.h;
/// ring_stencils.h for radius 2) and give the same points: bit for bit where sums are symmetric (radius 1).
template <Scheme S>
class SubdivisionMesh : public std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh> {
  using Base = std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh>;

 public:
  /// Level 0. Throws InputError if the mesh does not suit the scheme. O(size log size).
  explicit SubdivisionMesh(const std::shared_ptr<const ControlMesh>& control, const S& scheme = {})
      : SubdivisionMesh(cut_to_manifold(control, basis_of(scheme) == Basis::linear), nullptr,
                        make_table({scheme, control->crease_method, control->triangle_subdivision}, *control)) {}
  explicit SubdivisionMesh(ControlMesh control, const S& scheme = {})
      : SubdivisionMesh(std::make_shared<const ControlMesh>(std::move(control)), scheme) {}

  const Rules<S>& rules() const { return table_->rules(); }

  int level() const { return parent_ ? parent_->level() + 1 : 0; }

  /// The next level, whole. The mesh must outlive it. Throws InputError where half-edges, which are paired by
  /// their ends, cannot hold the result: beside a vertex of valence 2 a split triangle mesh has two edges between the
  /// same vertices. (Patches can.) O(size).
  std::unique_ptr<SubdivisionMesh> refine() const;

  /// The coarser mesh, null at level 0; and navigation between both.
  const SubdivisionMesh* parent() const { return parent_; }
  int child_count(int face) const { return S::face_kind == FaceKind::triangle ? 4 : this->face_size(face); }
  int child_face(int face, int k) const {
    return (S::face_kind == FaceKind::triangle ? 4 * face : this->half_edges().first(face)) + k;
  }
  int parent_face(int face) const { return parent_face_[static_cast<std::size_t>(face)]; }
  int child_of_vertex(int vertex) const { return vertex; }
  int child_of_edge(int edge) const { return this->vertex_count() + side_number(edge); }
  int child_of_face(int face) const { return this->vertex_count() + this->edge_count() + face; }  ///< quad split only

  /// The patch of a face, seen from one of its corners, as a value of its own. O(size of its neighbourhood).
  Patch<S> patch(Mesh::Corner corner) const {
    std::optional<PlainFace> plain;
    if (rules().radius() == 1) plain = plain_face(*this, corner);
    if (plain)
      if (const Configuration<S>* known = table_->plain(plain->valences)) return patch(known, plain->vertices);
    const auto match = table_->match(this->neighbourhood(corner, rules().radius()));
    if (plain) {
      assert(match.vertices == plain->vertices);
      table_->keep_plain(plain->valences, match.configuration);
    }
    return patch(match.configuration, match.vertices);
  }

  /// The configurations of the patches of all levels.
  ConfigurationTable<S>& table() const { return *table_; }

  /// Limit position and normal at corner k of a face, seen from that face.
  LimitSample limit(int face, int k) const {
    Patch<S> patch = this->patch({face, k});
    for (int level = 0; level <= detail::most_levels; ++level, patch = patch.child(0))
      if (std::optional<LimitSample> limit = evaluate_corner(patch, 0)) return *limit;
    return {patch.points.front(), Vec3::Zero(), {}};  // of a scheme that does not converge
  }

  /// The limit position of a vertex that has a face; found once, then kept. Thread-safe.
  const Vec3& limit_point(int vertex) const {
    std::call_once(limits_made_, [&] { limits_ = std::make_unique<KeptLimits>(this->vertex_count()); });
    const auto at = static_cast<std::size_t>(vertex);
    std::call_once(limits_->known[at], [&] {
      const Mesh::Corner corner = this->corner_at(vertex);
      limits_->points[at] = limit(corner.face, corner.place).position;
    });
    return limits_->points[at];
  }

  /// The unit normal of the plane through a face's limit points (quads: section 8.2 of the paper).
  Vec3 chord_normal(int face) const {
    std::vector<Vec3> limit_points;
    for (const int vertex : this->face(face)) limit_points.push_back(limit_point(vertex));
    return Base::chord_normal(limit_points);
  }

 private:
  SubdivisionMesh(ManifoldMesh topology, const SubdivisionMesh* parent, std::shared_ptr<ConfigurationTable<S>> table)
      : Base(std::move(topology)), table_(std::move(table)), parent_(parent) {}

  static std::shared_ptr<ConfigurationTable<S>> make_table(Rules<S> rules, const ControlMesh& control) {
    std::vector<int> faces_at(control.positions.size(), 0);
    int most = 6;  // neighbours that a vertex has at any level: one more than its faces; later, the corners of a face
    for (const int vertex : control.face_vertices)
      most = std::max(most, ++faces_at[static_cast<std::size_t>(vertex)] + 1);
    for (int f = 0; f < control.face_count(); ++f) most = std::max(most, control.face_size(f));
    const bool is_convex = has_convex_masks(rules, most);
    return std::make_shared<ConfigurationTable<S>>(std::move(rules), is_convex);
  }

  Patch<S> patch(const Configuration<S>* configuration, const std::vector<int>& vertices) const {
    Patch<S> result{configuration, {}};
    result.points.reserve(vertices.size());
    for (const int vertex : vertices) result.points.push_back(this->point(vertex));
    return result;
  }

  /// Edges are numbered among themselves, and so are sides between equal vertices, when a number is first asked for.
  int side_number(int side) const {
    std::call_once(sides_numbered_, [&] {
      const HalfEdges& half_edges = this->half_edges();
      int edges = 0, degenerate = 0;
      side_numbers_.resize(static_cast<std::size_t>(half_edges.side_count()));
      for (int s = 0; s < half_edges.side_count(); ++s)
        if (half_edges.edge(s) == s)
          side_numbers_[static_cast<std::size_t>(s)] = half_edges.is_degenerate(s) ? degenerate++ : edges++;
    });
    return side_numbers_[static_cast<std::size_t>(side)];
  }
  /// The new vertex on a side; sides between equal vertices have theirs behind all others.
  int child_of_side(int side) const {
    return this->half_edges().is_degenerate(side) ? first_behind_others() + side_number(side)
                                                  : child_of_edge(this->half_edges().edge(side));
  }
  int first_behind_others() const { return child_of_face(S::face_kind == FaceKind::quad ? this->face_count() : 0); }
  /// Of the next level.
  std::size_t refined_vertex_count() const {
    return static_cast<std::size_t>(first_behind_others() + this->half_edges().degenerate_side_count());
  }
  /// Calls visit(side, the vertex at both its ends).
  template <class Visit>
  void for_each_degenerate_side(Visit visit) const {
    const HalfEdges& half_edges = this->half_edges();
    if (half_edges.degenerate_side_count() == 0) return;
    for (int s = 0; s < half_edges.side_count(); ++s)
      if (half_edges.is_degenerate(s)) visit(s, half_edges.from(s));
  }
  std::vector<Vec3> refined_points() const;
  std::vector<Vec3> refined_points_by_stencils() const;
  ManifoldMesh refined_topology() const;
  void add_sharpness(ManifoldMesh& next) const;

  /// Limit points by vertex, and which are known.
  struct KeptLimits {
    explicit KeptLimits(int vertices)
        : points(static_cast<std::size_t>(vertices)), known(static_cast<std::size_t>(vertices)) {}
    std::vector<Vec3> points;
    std::vector<std::once_flag> known;
  };

  std::shared_ptr<ConfigurationTable<S>> table_;
  mutable std::once_flag limits_made_;
  mutable std::unique_ptr<KeptLimits> limits_;
  mutable std::once_flag sides_numbered_;
  mutable std::vector<int> side_numbers_;
  const SubdivisionMesh* parent_;
  std::vector<int> parent_face_;
};

/// Radius 2. Rings are made once, for every stencil reads several.
template <Scheme S>
std::vector<Vec3> SubdivisionMesh<S>::refined_points_by_stencils() const {
  std::vector<Ring> rings(static_cast<std::size_t>(this->vertex_count()));
  for (const int v : this->vertices())
    if (this->corner_at(v).face >= 0) rings[static_cast<std::size_t>(v)] = this->ring(this->corner_at(v));
  const RingStencils stencils(rules(), [&](int vertex) { return &rings[static_cast<std::size_t>(vertex)]; });

  const Vec3* points = this->points().data();
  std::vector<Vec3> result(refined_vertex_count());
  for (const int v : this->vertices()) {
    const Ring& ring = rings[static_cast<std::size_t>(v)];
    result[static_cast<std::size_t>(v)] = ring.faces.empty() ? this->point(v) : stencils.vertex(ring).of(points);
    for (std::size_t i = 0; i < ring.spokes.size(); ++i) {
      const int e = ring.spokes[i].edge;
      if (this->half_edges().from(e) != v || this->half_edges().is_degenerate(e)) continue;
      result[static_cast<std::size_t>(child_of_edge(e))] = stencils.edge(ring, i).of(points);
    }
  }
  if (S::face_kind == FaceKind::quad)
    for (const int f : this->faces())
      result[static_cast<std::size_t>(child_of_face(f))] = stencils.face(this->face_sides(f)).of(points);
  for_each_degenerate_side(
      [&](int side, int v) { result[static_cast<std::size_t>(child_of_side(side))] = this->point(v); });
  return result;
}

template <Scheme S>
std::vector<Vec3> SubdivisionMesh<S>::refined_points() const {
  if (rules().radius() == 2) return refined_points_by_stencils();
  std::vector<Vec3> face_points(static_cast<std::size_t>(this->face_count()));
  for (const int f : this->faces()) {
    const std::span<const int> v = this->face(f);
    face_points[static_cast<std::size_t>(f)] =
        face_point({this->points().data(), v.data(), static_cast<int>(v.size())});
  }

  std::vector<Vec3> result(refined_vertex_count());
  for (const int v : this->vertices()) {
    result[static_cast<std::size_t>(v)] = this->point(v);
    if (this->corner_at(v).face < 0) continue;
    const Ring ring = this->ring(this->corner_at(v));
    std::vector<int> ends, faces;
    for (const Ring::Spoke& spoke : ring.spokes) ends.push_back(spoke.end);
    for (const FaceSides& face : ring.faces) faces.push_back(face.id());
    const int n = static_cast<int>(ends.size());
    const VertexTransition to = vertex_transition(ring.sharpness, ring.spoke_sharpness(), ring.half_sharpness());
    result[static_cast<std::size_t>(v)] =
        vertex_point(to, rules().vertex(n, to, ring.cone), rules().crease(), this->point(v),
                     {this->points().data(), ends.data(), n}, {face_points.data(), faces.data(), ring.closed ? n : 0});
  }

  if (S::face_kind == FaceKind::quad)
    for (const int f : this->faces())
      result[static_cast<std::size_t>(child_of_face(f))] = face_points[static_cast<std::size_t>(f)];
  for_each_degenerate_side(
      [&](int side, int v) { result[static_cast<std::size_t>(child_of_side(side))] = this->point(v); });

  const HalfEdges& half_edges = this->half_edges();
  for (const int e : this->edges()) {
    const auto edge = this->edge(e);
    int triangles = 0;
    const auto across = [&](int side) -> const Vec3* {
      const int face = half_edges.face(side);
      triangles += this->face_size(face) == 3;
      if (S::face_kind == FaceKind::quad) return &face_points[static_cast<std::size_t>(face)];
      return &this->point(half_edges.from(half_edges.previous(side)));
    };
    const int twin = half_edges.twin(e);
    const Vec3 *left = across(e), *right = twin == e ? nullptr : across(twin);
    result[static_cast<std::size_t>(child_of_edge(e))] =
        edge_point(rules().edge(triangles), edge_crease_share(edge.sharpness, edge.half_a, edge.half_b),
                   this->point(edge.a), this->point(edge.b), left, right);
  }
  return result;
}

template <Scheme S>
ManifoldMesh SubdivisionMesh<S>::refined_topology() const {
  PolygonMesh polygons;
  std::vector<char> has_limit;
  const auto add = [&](int face, std::initializer_list<int> corners) {
    polygons.add_face({corners.begin(), corners.size()});
    has_limit.push_back(this->has_limit(face));
  };
  for (const int f : this->faces()) {
    const std::span<const int> v = this->face(f);
    const int n = static_cast<int>(v.size());
    std::vector<int> side;
    for (int i = 0; i < n; ++i) side.push_back(child_of_side(this->half_edges().first(f) + i));
    if (S::face_kind == FaceKind::triangle) {
      add(f, {v[0], side[0], side[2]});
      add(f, {side[0], v[1], side[1]});
      add(f, {side[2], side[1], v[2]});
      add(f, {side[1], side[2], side[0]});
      continue;
    }
    const int centre = child_of_face(f);
    for (std::size_t k = 0; k < v.size(); ++k) {
      const int before = side[(k + v.size() - 1) % v.size()];
      std::array<int, 4> quad{v[k], side[k], centre, before};
      // Children of a quad keep its orientation, as Domain<quad> says.
      if (n == 4) std::rotate(quad.begin(), quad.begin() + static_cast<std::ptrdiff_t>((4 - k) % 4), quad.end());
      add(f, {quad[0], quad[1], quad[2], quad[3]});
    }
  }
  polygons.positions = refined_points();
  ManifoldMesh next(HalfEdges(std::make_shared<const PolygonMesh>(std::move(polygons))));
  next.has_limit = std::move(has_limit);
  next.crease_method = rules().creases;
  add_sharpness(next);
  return next;
}

template <Scheme S>
void SubdivisionMesh<S>::add_sharpness(ManifoldMesh& next) const {
  next.vertex_sharpness.assign(refined_vertex_count(), 0);
  for (const int v : this->vertices())
    next.vertex_sharpness[static_cast<std::size_t>(v)] = decayed(this->vertex_sharpness(v));
  next.is_cone.assign(next.vertex_sharpness.size(), 0);
  for (const int v : this->vertices()) next.is_cone[static_cast<std::size_t>(v)] = this->is_cone(v);
  const auto set = [&](int a, int b, float sharpness) {
    if (is_sharp(sharpness)) next.sharp_edges[ManifoldMesh::edge_key(a, b)] = sharpness;
  };
  for (const int e : this->edges()) {
    const auto edge = this->edge(e);
    set(edge.a, child_of_edge(e), edge.half_a);
    set(edge.b, child_of_edge(e), edge.half_b);
  }
  // An edge between equal vertices is a point: its new vertex stays there, and both its halves are sharp.
  for_each_degenerate_side([&](int side, int v) {
    const int middle = child_of_side(side);
    next.vertex_sharpness[static_cast<std::size_t>(middle)] = infinite_sharpness;
    set(v, middle, infinite_sharpness);
  });
}

template <Scheme S>
std::unique_ptr<SubdivisionMesh<S>> SubdivisionMesh<S>::refine() const {
  std::unique_ptr<SubdivisionMesh> next(new SubdivisionMesh(refined_topology(), this, table_));
  for (const int f : this->faces())
    for (int k = 0; k < child_count(f); ++k) next->parent_face_.push_back(f);
  return next;
}

}  // namespace shaolin
