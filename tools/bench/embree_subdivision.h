#pragma once
/// Catmull-Clark surfaces as Embree's own subdivision geometry.
#include "schemes/control_mesh.h"
#include "tools/bench/embree_parts.h"

namespace shaolin {

/// With 2^level segments along each edge and the mesh's creases, corners and boundary mode; not committed yet. Throws
/// InputError for tags that Embree's geometry does not know or takes otherwise (Chaikin creases, smooth triangles,
/// conical vertices, holes). Some semi-sharp vertices differ from OpenSubdiv's, too (edges of sharpness 5, 5 and 0.1 at
/// one vertex do): compare the answers before comparing times.
EmbreeGeometry embree_subdivision(RTCDevice device, const ControlMesh& mesh, int level);

}  // namespace shaolin
