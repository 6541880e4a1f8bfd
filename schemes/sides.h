#pragma once
/// The sides of faces, and which of them lie at one edge.
#include <span>
#include <vector>

#include "polygon_mesh.h"

namespace shaolin {

/// A side leaves a corner of a face and runs to the next; its number is the corner's place in the list of all faces'
/// vertices. The mesh must outlive it.
class Sides {
 public:
  /// O(size).
  explicit Sides(const PolygonMesh& mesh);

  int side_count() const { return static_cast<int>(mesh_->face_vertices.size()); }
  int face(int side) const {
    if (size_ == 4) return side / 4;
    if (size_ == 3) return side / 3;
    return faces_[static_cast<std::size_t>(side)];
  }
  int first(int face) const { return mesh_->face_offsets[static_cast<std::size_t>(face)]; }
  int place(int side) const { return side - first(face(side)); }
  int next(int side) const {
    const int f = face(side);
    return side + 1 == first(f + 1) ? first(f) : side + 1;
  }
  int previous(int side) const {
    const int f = face(side);
    return side == first(f) ? first(f + 1) - 1 : side - 1;
  }
  int from(int side) const { return mesh_->face_vertices[static_cast<std::size_t>(side)]; }
  int to(int side) const { return from(next(side)); }
  /// Between equal vertices.
  bool is_degenerate(int side) const { return from(side) == to(side); }

 private:
  const PolygonMesh* mesh_;
  int size_ = 0;            ///< of all faces, if they are all triangles or all quads
  std::vector<int> faces_;  ///< else the face of each side
};

/// All sides, those of one edge together.
class SidesByEdge {
 public:
  /// O(size log valence).
  explicit SidesByEdge(const Sides& sides);

  /// Calls visit(sides of an edge), a span, for each edge in the order of its lower vertex, then its higher one. Sides
  /// of an edge are in order of their numbers.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t begin = 0, end; begin < order_.size(); begin = end) {
      end = begin + 1;
      while (end < order_.size() && are_of_one_edge(order_[begin], order_[end])) ++end;
      visit(std::span(order_).subspan(begin, end - begin));
    }
  }

 private:
  bool are_of_one_edge(int a, int b) const {
    const int from = sides_->from(a), to = sides_->to(a), other_from = sides_->from(b), other_to = sides_->to(b);
    return (from == other_to && to == other_from) || (from == other_from && to == other_to);
  }

  const Sides* sides_;
  std::vector<int> order_;
};

}  // namespace shaolin
