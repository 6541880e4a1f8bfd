#pragma once
/// What patches share: vertices and edges of a control mesh, as the places of the limit surface where rays go wrong.
#include <cstddef>
#include <utility>
#include <vector>

#include "schemes/limit_surface.h"

namespace shaolin::stress {

/// A vertex: its corner in each face around it that has a limit.
using VertexSite = std::vector<SurfaceParameter>;

/// An edge: its faces that have a limit, and which of their sides it is.
struct EdgeSite {
  struct Side {
    int face;
    int corner;     ///< the side goes from this corner of the face to the next
    bool backward;  ///< against the edge's direction
  };
  std::vector<Side> sides;
};

/// All of a surface, each kind in the order of the control mesh.
struct Sites {
  std::vector<VertexSite> vertices;
  std::vector<EdgeSite> edges;
  std::vector<EdgeSite> creases;  ///< of the edges, those with a sharpness, and boundaries
  std::vector<VertexSite>
      extraordinary;  ///< of other than regular valence, tagged, at ends of creases; n-gons' middles
  std::vector<std::pair<int, int>> pieces;  ///< (face, sub) with a limit

  explicit Sites(const LimitSurface& surface);
};

/// The point at `along` in [0, 1] of an edge, in the parameters of one of its faces.
SurfaceParameter on_edge(const LimitSurface& surface, const EdgeSite::Side& side, double along);

/// The corner of a face at its control vertex number k.
SurfaceParameter at_corner(const LimitSurface& surface, int face, int k);

}  // namespace shaolin::stress
