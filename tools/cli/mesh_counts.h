#pragma once
/// The counts that `shaolin info` prints, taken from the control mesh alone.
#include <cstddef>
#include <map>

#include "schemes/control_mesh.h"

namespace shaolin {

/// Counts at level 0. A vertex's kind follows from the sharp edges that meet there (boundary, non-manifold and crease
/// edges alike, the semi-sharp ones included): none smooth, 1 dart, 2 crease, more corner; a sharp vertex is a corner,
/// and so is a vertex with one face under BoundaryInterpolation::edge_and_corner.
struct MeshCounts {
  std::size_t vertices = 0, faces = 0, edges = 0;
  std::map<int, std::size_t> faces_by_size;
  std::map<int, std::size_t> vertices_by_valence;  ///< valence: number of edges; 0: isolated

  std::size_t smooth = 0, conical = 0, dart = 0, crease = 0,
              corner = 0;  ///< vertices by kind; isolated ones are in none
  std::size_t boundary_vertices = 0;
  std::size_t isolated_vertices = 0;
  /// Vertices whose valence the scheme's regular patches do not have: inside not 4 (Loop 6), at a boundary not 3
  /// (Loop 4). Crease rules do not count here.
  std::size_t extraordinary = 0;

  std::size_t infinite_creases = 0;    ///< edges tagged with sharpness >= infinite_sharpness
  std::size_t semi_sharp_creases = 0;  ///< edges tagged with a sharpness between 0 and infinite_sharpness
  std::size_t infinite_corners = 0;    ///< vertices, by their tags alone
  std::size_t semi_sharp_corners = 0;
  std::size_t boundary_edges = 0;      ///< edges with one face
  std::size_t non_manifold_edges = 0;  ///< edges with more than two faces
  std::size_t holes = 0;
};

/// Counts a checked mesh. `regular_valence` is the scheme's inside the mesh: 4 for Catmull-Clark, 6 for Loop.
/// O(size of the mesh).
MeshCounts count(const ControlMesh& mesh, int regular_valence);

}  // namespace shaolin
