#pragma once
/// The mesh hierarchy of Mueller et al. 2003, section 5: an abstract mesh with its navigation; triangle and quad
/// meshes; subdivision meshes (subdivision_mesh.h) derive from those. OpenMesh holds the half-edges.
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <span>
#include <vector>

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

/// A manifold mesh with sharpness. Vertices are cut vertices (see manifold.h), faces keep the input's numbers.
class Mesh {
 public:
  virtual ~Mesh() = default;

  /// The split that faces of this mesh take.
  virtual FaceKind face_kind() const = 0;

  int vertex_count() const { return static_cast<int>(points_.size()); }
  int edge_count() const { return static_cast<int>(connectivity_.n_edges()); }
  int face_count() const { return static_cast<int>(has_limit_.size()); }

  IndexRange vertices() const { return {vertex_count()}; }
  IndexRange edges() const { return {edge_count()}; }
  IndexRange faces() const { return {face_count()}; }

  const std::vector<Vec3>& points() const { return points_; }
  const Vec3& point(int vertex) const { return points_[static_cast<std::size_t>(vertex)]; }
  /// True if the vertex keeps a tangent cone, see ControlMesh::cones.
  bool is_cone(int vertex) const { return is_cone_[static_cast<std::size_t>(vertex)] != 0; }
  float vertex_sharpness(int vertex) const { return vertex_sharpness_[static_cast<std::size_t>(vertex)]; }

  /// An edge's two ends, its sharpness, and that of its halves at either end, one level finer.
  struct Edge {
    int a, b;
    float sharpness, half_a, half_b;
  };
  Edge edge(int edge) const;

  /// A face's vertices in order (with the input's repeats).
  std::span<const int> face(int face) const {
    return {face_vertices_.data() + first_corner(face), static_cast<std::size_t>(face_size(face))};
  }
  int face_size(int face) const { return first_corner(face + 1) - first_corner(face); }

  /// The same with its sides, seen from its first corner. A view into the mesh.
  FaceSides face_sides(int face) const { return face_from({face, 0}); }

  /// False for holes and for faces at a boundary that is not interpolated.
  bool has_limit(int face) const { return has_limit_[static_cast<std::size_t>(face)] != 0; }

  /// A face and a place in its vertices.
  struct Corner {
    int face, place;
  };
  /// One corner at a vertex; face -1 if the vertex has no face.
  Corner corner_at(int vertex) const { return corner_at_[static_cast<std::size_t>(vertex)]; }

  /// The ring of the vertex at a corner. It starts at the boundary if there is one. O(valence).
  Ring ring(Corner corner) const;

  /// A face, seen from one of its corners, with the rings of the vertices within radius - 1 faces of it. The mesh must
  /// outlive it. O(sum of the rings).
  Neighbourhood neighbourhood(Corner corner, int radius) const;

 protected:
  using HalfEdge = OpenMesh::HalfedgeHandle;

  /// Throws InputError if a face does not suit the mesh.
  Mesh(const ManifoldMesh& topology, std::vector<Vec3> points);

  /// The number of the side that leaves a corner among sides between equal vertices; -1 if it is none.
  int degenerate_side(Corner corner) const { return repeats_next(corner) ? side(corner) - edge_count() : -1; }
  int degenerate_side_count() const { return degenerate_side_count_; }
  const OpenMesh::PolyConnectivity& connectivity() const { return connectivity_; }
  int side(Corner corner) const { return face_sides_[index(corner)]; }

 private:
  void build_half_edges();
  void number_sides();
  HalfEdge half_edge(Corner corner) const;
  int first_corner(int face) const { return face_offsets_[static_cast<std::size_t>(face)]; }
  std::size_t index(Corner corner) const { return static_cast<std::size_t>(first_corner(corner.face) + corner.place); }
  int vertex_at(Corner corner) const { return face_vertices_[index(corner)]; }
  /// The corner before this one in its face.
  Corner previous(Corner corner) const {
    return {corner.face, (corner.place == 0 ? face_size(corner.face) : corner.place) - 1};
  }
  bool repeats_next(Corner corner) const { return side(corner) >= edge_count(); }
  Corner next_clockwise(Corner corner) const;
  Corner next_counter_clockwise(Corner corner) const;
  /// The face seen from the corner.
  FaceSides face_from(Corner corner) const {
    const auto first = static_cast<std::size_t>(first_corner(corner.face));
    return FaceSides(corner.face, &face_vertices_[first], &face_sides_[first], face_size(corner.face))
        .turned(corner.place);
  }
  Ring::Spoke spoke(Corner side, int from) const;
  void set_edge_sharpness(const ManifoldMesh& topology);
  Corner corner_of(HalfEdge half_edge, int vertex) const;

  OpenMesh::PolyConnectivity connectivity_;  ///< its faces have our numbers
  std::vector<Vec3> points_;
  std::vector<int> face_offsets_, face_vertices_;
  std::vector<int> face_sides_;          ///< edges; from edge_count() on sides between equal vertices
  std::vector<int> place_of_half_edge_;  ///< in its face
  std::vector<float> vertex_sharpness_;
  std::vector<std::array<float, 3>> edge_sharpness_;  ///< its own, then of its halves (see Edge)
  std::vector<char> is_cone_, has_limit_;
  std::vector<Corner> corner_at_;
  int degenerate_side_count_ = 0;
};

/// Triangles only.
class TriangleMesh : public Mesh {
 public:
  FaceKind face_kind() const override { return FaceKind::triangle; }

  /// The unit normal of the chord triangle over three limit points, along (b - a) x (c - a).
  static Vec3 chord_normal(const std::vector<Vec3>& limit_points);

 protected:
  /// Throws InputError that names the first face that is no triangle.
  TriangleMesh(const ManifoldMesh& topology, std::vector<Vec3> points);
};

/// Faces of any number of corners; quads after the first split.
class QuadMesh : public Mesh {
 public:
  FaceKind face_kind() const override { return FaceKind::quad; }

  /// The unit normal of the plane of section 8.2: the sum of d_i x d_(i+1) over the chord polygon's edges d_i.
  static Vec3 chord_normal(const std::vector<Vec3>& limit_points);

 protected:
  QuadMesh(const ManifoldMesh& topology, std::vector<Vec3> points) : Mesh(topology, std::move(points)) {}
};

}  // namespace shaolin
