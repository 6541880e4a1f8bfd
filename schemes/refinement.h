#pragma once
/// The refinement of the topology around a face.
#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <memory_resource>
#include <vector>

#include "numbering.h"
#include "ring.h"
#include "scheme.h"
#include "sharpness.h"

namespace shaolin {

/// Where a vertex of the next level comes from.
struct RefinedVertex {
  enum class Kind { vertex, edge, face } kind;
  int id;  ///< of the vertex, edge or face
  auto operator<=>(const RefinedVertex&) const = default;
};

/// The topology of the next level around a face, and its neighbourhoods of the face's children.
class Refinement {
 public:
  /// `parent` must outlive the refinement.
  Refinement(const Neighbourhood& parent, FaceKind kind, CreaseMethod creases);

  /// The number of children of the face: 4, or the number of corners of an n-gon.
  int child_count() const;

  /// The neighbourhood of child k, for patches of the given radius, with vertices named by index into vertices().
  /// Children keep the face's orientation (see Domain); child k of an n-gon begins at the n-gon's corner k. The
  /// refinement must outlive the neighbourhood, whose faces look into it.
  Neighbourhood child(int k, int radius);

  const std::vector<RefinedVertex>& vertices() const { return vertices_; }

 private:
  int vertex(const RefinedVertex& from);
  int from_vertex(int id) { return vertex({RefinedVertex::Kind::vertex, id}); }
  int from_edge(int id) { return vertex({RefinedVertex::Kind::edge, id}); }
  int from_face(int id) { return vertex({RefinedVertex::Kind::face, id}); }

  /// Identifiers of the next level's edges and faces: half an edge, the edge inside a face that ends on a side (quads)
  /// or runs along it (triangles), and the child at a corner (by the side that leaves it) or the middle one.
  int half(int edge, int end) { return edge_ids_({0, edge, end}); }
  int inner(int face, int side) { return edge_ids_({1, face, side}); }

  FaceSides child_face(int k);
  FaceSides corner_face(const FaceSides& parent, int at, int first);
  FaceSides middle_face(const FaceSides& parent, int first);
  template <class Lists>
  FaceSides made(int id, int size, Lists lists);

  /// An edge as a spoke of a ring.
  struct Place {
    const Ring* ring;
    std::size_t spoke;
    const FaceSides *left, *right;  ///< null outside a boundary
  };
  Place place_of_edge(int edge) const;

  Ring ring(int refined);
  Ring ring_of_vertex(int v);
  Ring ring_of_edge(int edge);
  Ring ring_of_face(const FaceSides& face);
  SemiSharpEdges halves_around(int v) const;
  void add_side(Ring& ring, const FaceSides& face, int at);

  std::array<std::byte, 16384> buffer_;  // for the many short-lived nodes of the maps
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
  const Neighbourhood& parent_;
  FaceKind kind_;
  CreaseMethod creases_;
  std::pmr::map<int, const Ring*> rings_{&memory_};
  std::pmr::map<int, FaceSides> faces_{&memory_};
  Numbering<2> numbers_;  ///< of vertices, by kind and identifier
  std::vector<RefinedVertex> vertices_;
  Numbering<3> edge_ids_, face_ids_;
  std::pmr::deque<FaceSides> children_{&memory_};        ///< the next level's faces by identifier
  std::pmr::deque<std::array<int, 8>> lists_{&memory_};  ///< that they look at: four vertices, four sides
};

}  // namespace shaolin
