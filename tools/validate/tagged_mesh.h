#pragma once
/// The oracle's own mesh: all incidences and every decision about sharpness are explicit, so that any piece of it
/// refines alone as it does in the whole. Refinement is OpenSubdiv's.
#include <opensubdiv/far/topologyRefiner.h>

#include <array>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "schemes/vec3.h"

namespace shaolin {

/// The scheme and the options that act during refinement. Boundaries are "edge only" here: which corners are sharp was
/// decided on the control mesh and is carried as vertex sharpness, so the rim of a cut-out sharpens no vertex.
struct SubdivisionRules {
  OpenSubdiv::Sdc::SchemeType scheme;
  OpenSubdiv::Sdc::Options options;

  bool triangular() const { return scheme == OpenSubdiv::Sdc::SCHEME_LOOP; }
  int face_size() const { return triangular() ? 3 : 4; }
};

/// A list of indices per element.
class Relation {
 public:
  int size() const { return static_cast<int>(offsets_.size()) - 1; }
  int count(int element) const { return offsets_[element + 1] - offsets_[element]; }
  std::span<const int> operator[](int element) const {
    return {items_.data() + offsets_[element], static_cast<std::size_t>(count(element))};
  }
  void push(int item) { items_.push_back(item); }
  /// Ends the current element's list.
  void close() { offsets_.push_back(static_cast<int>(items_.size())); }
  template <class Range>
  void append(const Range& items) {
    items_.insert(items_.end(), items.begin(), items.end());
    close();
  }

 private:
  std::vector<int> offsets_{0}, items_;
};

/// Points and incidences in OpenSubdiv's order: around a manifold vertex counter-clockwise, edge i leads face i. Edges
/// are elements of their own, because two may join the same vertices (below an interior vertex of valence 2). "Slots"
/// tell the place of the element within the related one: vertex v is corner vertex_face_slots[v][i] of face
/// vertex_faces[v][i].
struct TaggedMesh {
  std::vector<Vec3> points;
  Relation face_vertices, face_edges;  ///< edge i of a face leads from its corner i to the next
  std::vector<std::array<int, 2>> edge_vertices;
  Relation edge_faces, edge_face_slots;
  Relation vertex_faces, vertex_face_slots, vertex_edges, vertex_edge_slots;
  std::vector<float> edge_sharpness, vertex_sharpness;
  std::vector<char> edge_non_manifold, vertex_non_manifold;
  std::vector<char> vertex_cone;  ///< ours, see ControlMesh::cones: OpenSubdiv's refinement carries it, and no more

  int vertex_count() const { return static_cast<int>(points.size()); }
  int edge_count() const { return static_cast<int>(edge_vertices.size()); }
  int face_count() const { return face_vertices.size(); }
  int next_edge(int face, int corner) const { return face_edges[face][corner]; }
  int previous_edge(int face, int corner) const;
  int next_vertex(int face, int corner) const;
  int previous_vertex(int face, int corner) const;
  /// Between two faces that agree about its direction.
  bool is_manifold(int edge) const { return edge_faces.count(edge) == 2 && !edge_non_manifold[edge]; }
  /// Infinitely sharp, by tag or because it is not manifold.
  bool is_crease(int edge) const;

  /// Moves the points so that `vertex` is the origin; returns where it was.
  Vec3 recentre(int vertex);
};

/// OpenSubdiv's infinite sharpness.
inline constexpr float osd_infinite = 10.0f;

/// A subset of a mesh's faces as a mesh, with all tags; the maps lead from the old indices to the new. Vertices that
/// lose faces become boundary vertices, or non-manifold if what is left of them is not one fan.
struct CutOut {
  TaggedMesh mesh;
  std::unordered_map<int, int> vertex_index, face_index;
};

/// The named faces, each once. O(their size).
CutOut cut_faces(const TaggedMesh& mesh, std::span<const int> faces);
/// The faces within `rings` rings of the vertex; faces that share a vertex are adjacent. O(their size).
CutOut cut_rings(const TaggedMesh& mesh, int vertex, int rings);
/// The face and those within `rings` rings of its vertices.
CutOut cut_neighbourhood(const TaggedMesh& mesh, int face, int rings);

/// OpenSubdiv's refiner with this mesh as its base level. Throws std::runtime_error if OpenSubdiv declines the mesh.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const TaggedMesh& mesh, const SubdivisionRules& rules);

/// The topology and the sharpness of one of OpenSubdiv's levels; no vertex is conical.
TaggedMesh tagged_level(const OpenSubdiv::Far::TopologyLevel& level, std::vector<Vec3> points);

/// A mesh after one uniform step, with OpenSubdiv's child indices. The children of a regular face keep its frame:
/// child i holds the child of corner i as its vertex i; a triangle's child 3 is the middle one, turned by half a turn.
/// Child i of an n-gon has the child of corner i as its vertex 0, then the outgoing edge's point.
struct Refined {
  TaggedMesh mesh;
  std::vector<int> vertex_child;
  Relation face_children;
};

/// One uniform step in double precision. O(size).
Refined refine(const TaggedMesh& mesh, const SubdivisionRules& rules);

/// The child of a quad or triangle that a parameter lies in, the parameter in the child's frame, and the frame's
/// direction against the parent's. Halves belong to a quad's lower child and to a triangle's middle one.
struct ChildPlace {
  int child;
  double u, v;
  int direction;
};
ChildPlace child_place(bool triangular, double u, double v);

}  // namespace shaolin
