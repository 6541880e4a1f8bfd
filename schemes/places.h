#pragma once
/// Which places of a surface are one point.
#include <vector>

#include "limit_sample.h"

namespace shaolin {

class Mesh;

/// All places that are one point of the surface, each once.
struct PointPlaces {
  std::vector<SurfaceParameter> all;
  bool is_closed;  ///< the faces around it are a disk: it is inside of them, or on an edge or vertex that has all of
                   ///< them
};

/// The places that are the point at `at`: its own, those across a side, or at a vertex those of all faces around it,
/// also within n-gons, between the quads of their corners. Faces without a limit have none. Where a non-manifold mesh
/// is cut, they are those on this side of the cut. Across a side parameters are exact if 1 - u and 1 - v are.
/// O(valence).
PointPlaces places_of(const Mesh& mesh, const SurfaceParameter& at);

}  // namespace shaolin
