#pragma once
/// The mesh hierarchy of Mueller et al. 2003, section 5: an abstract mesh with its navigation; triangle and quad
/// meshes; subdivision meshes (subdivision_mesh.h) derive from those.
#include <mutex>
#include <span>
#include <vector>

#include "half_edges.h"
#include "manifold.h"
#include "ring.h"
#include "scheme.h"
#include "vec3.h"

namespace shaolin {

/// The indices 0, 1, ... count - 1, to iterate over. (std::views::iota, but for Clang 14, which cannot compile GCC
/// 12's.)
struct IndexRange {
  struct Iterator {
    int index;
    int operator*() const { return index; }
    Iterator& operator++() {
      ++index;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };
  int count;

  Iterator begin() const { return {0}; }
  Iterator end() const { return {count}; }
};

/// The edges of half-edges, to iterate over: each by the lesser of its sides.
struct EdgeRange {
  struct Iterator {
    const HalfEdges* half_edges;
    int edge;
    int operator*() const { return edge; }
    Iterator& operator++() {
      ++edge;
      return skip();
    }
    Iterator& skip() {
      while (edge < half_edges->side_count() && (half_edges->twin(edge) < edge || half_edges->is_degenerate(edge)))
        ++edge;
      return *this;
    }
    bool operator==(const Iterator&) const = default;
  };
  const HalfEdges* half_edges;

  Iterator begin() const { return Iterator{half_edges, 0}.skip(); }
  Iterator end() const { return {half_edges, half_edges->side_count()}; }
};

/// A manifold mesh with sharpness. Vertices are cut vertices (see manifold.h), faces keep the input's numbers.
class Mesh {
 public:
  virtual ~Mesh() = default;

  /// The split that faces of this mesh take.
  virtual FaceKind face_kind() const = 0;

  int vertex_count() const { return static_cast<int>(points().size()); }
  int edge_count() const { return half_edges_.edge_count(); }
  int face_count() const { return polygons().face_count(); }

  IndexRange vertices() const { return {vertex_count()}; }
  /// Edges have the numbers of half-edges, not all of them (see HalfEdges::edge()).
  EdgeRange edges() const { return {&half_edges_}; }
  IndexRange faces() const { return {face_count()}; }

  const HalfEdges& half_edges() const { return half_edges_; }
  const std::vector<Vec3>& points() const { return polygons().positions; }
  const Vec3& point(int vertex) const { return points()[static_cast<std::size_t>(vertex)]; }
  /// True if the vertex keeps a tangent cone, see ControlMesh::cones.
  bool is_cone(int vertex) const { return has(vertex, cone); }
  float vertex_sharpness(int vertex) const { return has(vertex, sharp) ? sharpness_of(vertex) : 0; }
  /// True of a vertex that is no cone, not sharp, and has no sharp edge.
  bool is_plain(int vertex) const { return tags_[static_cast<std::size_t>(vertex)] == 0; }
  /// True if one of the vertex's edges is sharp.
  bool has_sharp_edge(int vertex) const { return has(vertex, sharp_edge); }

  /// An edge's two ends, its sharpness, and that of its halves at either end, one level finer.
  struct Edge {
    int a, b;
    float sharpness, half_a, half_b;
  };
  Edge edge(int edge) const;

  /// A face's vertices in order (with the input's repeats).
  std::span<const int> face(int face) const { return polygons().face(face); }
  int face_size(int face) const { return polygons().face_size(face); }

  /// The same with its sides, seen from its first corner. A view into the mesh.
  FaceSides face_sides(int face) const {
    const int first = half_edges_.first(face);
    return FaceSides(face, polygons().face_vertices.data() + first, half_edges_.twins().data() + first, face_size(face),
                     first);
  }

  /// False for holes and for faces at a boundary that is not interpolated.
  bool has_limit(int face) const { return has_limit_.empty() || has_limit_[static_cast<std::size_t>(face)] != 0; }

  bool all_have_limit() const { return has_limit_.empty(); }

  /// A face and a place in its vertices.
  struct Corner {
    int face, place;
  };
  /// One corner at a vertex; face -1 if the vertex has no face.
  Corner corner_at(int vertex) const;

  /// The ring of the vertex at a corner. It starts at the boundary if there is one. O(valence).
  Ring ring(Corner corner) const;

  /// A face, seen from one of its corners, with the rings of the vertices within radius - 1 faces of it. The mesh must
  /// outlive it. O(sum of the rings).
  Neighbourhood neighbourhood(Corner corner, int radius) const;

 protected:
  /// Throws InputError if half-edges cannot hold a face.
  explicit Mesh(ManifoldMesh topology);

 private:
  enum Tag : unsigned char { cone = 1, sharp = 2, sharp_edge = 4 };
  bool has(int vertex, Tag tag) const { return (tags_[static_cast<std::size_t>(vertex)] & tag) != 0; }
  void set(int vertex, Tag tag) { tags_[static_cast<std::size_t>(vertex)] |= tag; }

  const PolygonMesh& polygons() const { return half_edges_.mesh(); }
  int corner_number(Corner corner) const { return half_edges_.first(corner.face) + corner.place; }
  /// The face seen from a corner.
  FaceSides face_from(int corner) const {
    return face_sides(half_edges_.face(corner)).turned(half_edges_.place(corner));
  }
  Ring ring_at(int corner) const;
  Ring::Spoke spoke(int side, int from) const;
  float sharpness_of(int vertex) const;
  void set_edge_sharpness(const ManifoldMesh& topology);
  const std::vector<int>& corners_at() const;

  /// Most vertices and edges are not sharp: those that are, are looked up if a vertex's tags say so.
  struct SharpHalves {
    int edge;
    float sharpness, half_a, half_b;  ///< see Edge
  };

  HalfEdges half_edges_;
  std::vector<unsigned char> tags_;          ///< by vertex
  std::vector<SharpVertex> sharp_vertices_;  ///< by vertex in order
  std::vector<SharpHalves> sharp_edges_;     ///< by edge in order
  std::vector<char> has_limit_;              ///< none if all have one
  mutable std::once_flag corners_found_;
  mutable std::vector<int> corners_at_;  ///< one by vertex, -1 if there is none; found when first asked for
};

/// Triangles only.
class TriangleMesh : public Mesh {
 public:
  FaceKind face_kind() const override { return FaceKind::triangle; }

  /// The unit normal of the chord triangle over three limit points, along (b - a) x (c - a).
  static Vec3 chord_normal(const std::vector<Vec3>& limit_points);

 protected:
  /// Throws InputError that names the first face that is no triangle.
  explicit TriangleMesh(ManifoldMesh topology);
};

/// Faces of any number of corners; quads after the first split.
class QuadMesh : public Mesh {
 public:
  FaceKind face_kind() const override { return FaceKind::quad; }

  /// The unit normal of the plane of section 8.2: the sum of d_i x d_(i+1) over the chord polygon's edges d_i.
  static Vec3 chord_normal(const std::vector<Vec3>& limit_points);

 protected:
  explicit QuadMesh(ManifoldMesh topology) : Mesh(std::move(topology)) {}
};

}  // namespace shaolin
