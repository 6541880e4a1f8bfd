#pragma once
/// Operations on the topology around a face: its reduction to what matters, and its refinement.
#include <array>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <map>
#include <memory_resource>
#include <tuple>
#include <vector>

#include "control_mesh.h"
#include "ring.h"
#include "scheme.h"
#include "sharpness.h"

namespace shaolin {

/// The place of corner k's own face in the corner's ring. (A face that repeats a vertex stands there more than once.)
int place_of_face(const Neighbourhood& neighbourhood, std::size_t k);

/// Opens the rings of the face's corners along infinitely sharp edges and keeps the sector that holds the face: what
/// lies beyond does not influence its patch. A ring is left whole while semi-sharp edges still count for its rule; a
/// sector that was cut out of three or more sharp edges gets an infinitely sharp vertex. A neighbourhood of radius 2 is
/// left with the rings of the vertices of faces around its corners.
void drop_beyond_creases(Neighbourhood& neighbourhood);

/// Turns every closed ring of a corner so that the face comes first (open rings begin at their first edge), and sorts
/// further rings in the order in which a walk around the corners meets them; closed ones begin at the face that it
/// comes from.
void turn_to_face(Neighbourhood& neighbourhood);

/// The vertices and faces of a neighbourhood numbered in the order of a fixed walk, so that equal topology gives equal
/// numbers. `vertices[i]` is the old name of vertex i; corners come first. `key` spells everything out.
struct CanonicalForm {
  std::vector<int> vertices;
  std::vector<int> key;
};
CanonicalForm canonical_form(const Neighbourhood& neighbourhood);

/// The neighbourhood in these numbers. (Few that are met are new, so most need no copy.)
Neighbourhood in_canonical_numbers(const Neighbourhood& neighbourhood);

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
  int half(int edge, int end) { return named(edge_ids_, {0, edge, end}); }
  int inner(int face, int side) { return named(edge_ids_, {1, face, side}); }
  using Names = std::pmr::map<std::tuple<int, int, int>, int>;
  static int named(Names& names, std::tuple<int, int, int> name) {
    return names.try_emplace(name, static_cast<int>(names.size())).first->second;
  }

  FaceSides child_face(int k);
  FaceSides corner_face(const FaceSides& parent, int at, int first);
  FaceSides middle_face(const FaceSides& parent, int first);
  FaceSides made(int id, std::initializer_list<int> vertices, std::initializer_list<int> sides);

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
  std::pmr::map<RefinedVertex, int> numbers_{&memory_};
  std::vector<RefinedVertex> vertices_;
  Names edge_ids_{&memory_}, face_ids_{&memory_};
  std::pmr::map<int, FaceSides> children_{&memory_};     ///< the next level's faces by identifier
  std::pmr::deque<std::array<int, 8>> lists_{&memory_};  ///< that they look at
};

}  // namespace shaolin
