#pragma once
/// Loop's limit surface as triangles, made by OpenSubdiv: what a renderer without subdivision surfaces would trace.
#include "schemes/control_mesh.h"
#include "tools/bench/embree_parts.h"

namespace shaolin {

/// Refines a triangle mesh uniformly `level` times (Far, single precision) and moves the points to the limit. Faces
/// that have no limit surface leave none. Throws InputError if OpenSubdiv refuses the mesh. O(4^level x mesh size).
EmbreeTriangles tessellate_loop(const ControlMesh& mesh, int level);

}  // namespace shaolin
