#pragma once
/// The half-edges of a polygon mesh: its sides, and for each the one that lies across its edge.
#include <memory>
#include <vector>

#include "sides.h"

namespace shaolin {

/// Four bytes a side beside the mesh's own lists (a corner table, Rossignac 2001, for faces of any size): OpenMesh's
/// kernel takes some 150 a quad, and longer to build than all else.
class HalfEdges : public Sides {
 public:
  /// Pairs the two sides of each edge that has two, in opposite directions. O(size log valence).
  explicit HalfEdges(std::shared_ptr<const PolygonMesh> mesh) : HalfEdges(Unpaired(), std::move(mesh)) {
    pair(SidesByEdge(*this));
  }

  const PolygonMesh& mesh() const { return *mesh_; }
  const std::shared_ptr<const PolygonMesh>& shared_mesh() const { return mesh_; }

  /// The side that runs the other way between the same vertices; `side` itself if there is none: at a boundary, and
  /// between equal vertices.
  int twin(int side) const { return twins_[static_cast<std::size_t>(side)]; }
  /// Of an edge, that is, the lesser of its sides.
  int edge(int side) const { return std::min(side, twin(side)); }
  const std::vector<int>& twins() const { return twins_; }

  int edge_count() const { return edge_count_; }
  int degenerate_side_count() const { return degenerate_side_count_; }
  /// A side that has no place beside the others of its edge, with more than two or two in one direction; -1 if there is
  /// none.
  int misfit() const { return misfit_; }

  /// A corner and that of the next face around its vertex, counter-clockwise or clockwise, across the side that enters
  /// or leaves it; -1 at a boundary or a side between equal vertices. Where the next face repeats the vertex, it is the
  /// last of the repeats counter-clockwise, the first clockwise.
  int counter_clockwise(int corner) const {
    const int side = previous(corner), across = twin(side);
    return across == side ? -1 : across;
  }
  int clockwise(int corner) const {
    const int across = twin(corner);
    return across == corner ? -1 : next(across);
  }

  /// True if no edge has sides that do not fit, no side lies between equal vertices, no face is its own neighbour, and
  /// the faces at each vertex are one fan. O(size).
  bool is_manifold() const;

 private:
  struct Unpaired {};
  HalfEdges(Unpaired, std::shared_ptr<const PolygonMesh> mesh) : Sides(*mesh), mesh_(std::move(mesh)) {}
  void pair(const SidesByEdge& edges);

  std::shared_ptr<const PolygonMesh> mesh_;
  std::vector<int> twins_;
  int edge_count_ = 0, degenerate_side_count_ = 0, misfit_ = -1;
};

}  // namespace shaolin
