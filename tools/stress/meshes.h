#pragma once
/// Meshes made by code: what models come from elsewhere do not have.
#include <vector>

#include "tools/stress/subject.h"

namespace shaolin::stress {

/// Small sound models of both face kinds: a torus, a body with creases of all kinds, poles, an open sheet with a dart.
std::vector<StressModel> sound_models();

/// Embree's watertight set-up: a sphere of radius 2 at (148376, 1234, -223423), in triangles and in quads.
std::vector<StressModel> distant_spheres();

/// Slivers, collapsed edges, duplicate points, needles and caps, all points collinear or equal, folded nets.
std::vector<StressModel> degenerate_models();

/// Closed bodies with two vertices of valence 3 to 100 and, in triangles, 1000; and vertices of interior valence 2.
std::vector<StressModel> valence_models();

/// A cube and an octahedron with loops and darts of each sharpness: 0.1, 3.5, 9.99, 10 and infinite.
std::vector<StressModel> sharpness_models();

}  // namespace shaolin::stress
