#pragma once
/// Loop's limit surface as triangles, made by OpenSubdiv: what a renderer without subdivision surfaces would trace.
#include <array>
#include <cstdint>
#include <vector>

#include "schemes/control_mesh.h"

namespace shaolin {

struct Tessellation {
  std::vector<std::array<float, 3>> points;  ///< on the limit surface
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Refines a triangle mesh uniformly `level` times (Far, single precision) and moves the points to the limit. Faces
/// that have no limit surface leave none. Throws InputError if OpenSubdiv refuses the mesh. O(4^level x mesh size).
Tessellation tessellate_loop(const ControlMesh& mesh, int level);

}  // namespace shaolin
