#pragma once
/// The topology around a vertex and around a face: what masks and sharpness rules are chosen by.
#include <algorithm>
#include <limits>
#include <vector>

namespace shaolin {

/// A face by its vertices and sides in order, seen from one of its corners: side i is the edge from vertex i to the
/// next. Identifiers tell faces, and edges, apart that have the same vertices (two edges join the same vertices beside
/// a triangle vertex of valence 2).
///
/// A view: the lists belong to a mesh, a refinement or a neighbourhood. (An n-gon stands in the rings of its n corners;
/// copies would take n^2.) Views of one owner with equal identifiers look at the same lists.
class FaceSides {
 public:
  FaceSides() = default;
  FaceSides(int id, const int* vertices, const int* sides, int size)
      : id_(id), size_(size), vertices_(vertices), sides_(sides) {}
  /// Of half-edges numbered from `first_side` on, and their twins: an edge has the lesser number of its two.
  FaceSides(int id, const int* vertices, const int* twins, int size, int first_side)
      : id_(id), size_(size), first_side_(first_side), vertices_(vertices), sides_(twins) {}

  int id() const { return id_; }
  int size() const { return size_; }

  /// Of place i in [0, size), counted from the corner that the face is seen from.
  int vertex(int i) const { return vertices_[place(i)]; }
  int side(int i) const {
    const int at = place(i);
    return std::min(sides_[at], first_side_ + at);
  }
  int last_vertex() const { return vertex(size_ - 1); }
  bool has_vertex(int wanted) const { return std::find(vertices_, vertices_ + size_, wanted) != vertices_ + size_; }

  /// The same face, seen from its corner i in [0, size).
  FaceSides turned(int i) const {
    FaceSides result = *this;
    result.first_ = place(i);
    return result;
  }

  /// The i that makes turned(i) equal to another view of the same face.
  int turn_to(const FaceSides& other) const { return (other.first_ - first_ + size_) % size_; }

 private:
  int place(int i) const { return first_ + i < size_ ? first_ + i : first_ + i - size_; }

  int id_ = 0;
  int size_ = 0;
  int first_ = 0;
  int first_side_ = std::numeric_limits<int>::max() / 2;  ///< above all
  const int* vertices_ = nullptr;
  const int* sides_ = nullptr;
};

/// A vertex with the edges and faces around it, counter-clockwise. Face i lies between spoke i and spoke i + 1.
struct Ring {
  struct Spoke {
    int end;  ///< the vertex at the other end of the edge
    int edge;
    float sharpness;
    float near_half = 0;  ///< the sharpness, one level finer, of the half at the ring's vertex
    float far_half = 0;   ///< and of the other half: under Chaikin's rule the edges around the far end have a say in it
  };

  int vertex = 0;
  bool closed = true;   ///< as many faces as spokes; else one face fewer (a boundary or a crease)
  float sharpness = 0;  ///< of the vertex
  bool cone = false;    ///< keeps a tangent cone (see ControlMesh::cones)
  std::vector<Spoke> spokes;
  std::vector<FaceSides> faces;  ///< each begins at the vertex, then the end of its spoke

  std::vector<float> spoke_sharpness() const {
    std::vector<float> values;
    for (const Spoke& spoke : spokes) values.push_back(spoke.sharpness);
    return values;
  }
  std::vector<float> half_sharpness() const {
    std::vector<float> values;
    for (const Spoke& spoke : spokes) values.push_back(spoke.near_half);
    return values;
  }
};

/// A face and the rings of the vertices that its patch depends on. The first rings belong to the face's corners in
/// order; a ring may be opened along sharp edges so that it holds the faces on this side only.
struct Neighbourhood {
  FaceSides face;
  std::vector<Ring> rings;
  std::vector<std::vector<int>> lists;  ///< what the faces look at, if the neighbourhood itself keeps it

  Neighbourhood() = default;
  Neighbourhood(Neighbourhood&&) = default;  ///< leaves the lists where they are
  Neighbourhood& operator=(Neighbourhood&&) = default;
};

}  // namespace shaolin
