#pragma once
/// The smallest meshes around a vertex of each kind: what a scheme is asked about, valence by valence.
#include <string>

#include "schemes/control_mesh.h"
#include "schemes/scheme.h"

namespace shaolin {

/// A vertex, by the rule that applies at it. A crease or corner is seen from one of its sides: a sector of faces.
enum class StarKind { smooth, dart, crease, corner };

std::string to_string(StarKind kind);

/// Faces around vertex 0, which is corner 0 of face 0, and as many more as the patches of those faces need. Smooth and
/// dart: closed, `faces` >= 3. Crease and corner: an open sector of `faces` >= 1 that ends at the boundary. Points lie
/// on the unit circles of a flat star, so that nothing is folded.
ControlMesh vertex_star(FaceKind face_kind, StarKind kind, int faces);

}  // namespace shaolin
