#pragma once
/// One step of a scheme that OpenSubdiv does not have: its topology and sharpness, a plain reading of the scheme's
/// masks.
#include "schemes/runtime_scheme.h"
#include "tools/validate/tagged_mesh.h"

namespace shaolin {

/// One uniform step. OpenSubdiv splits the mesh and its tags (`rules` has the split of the masks' faces); the new
/// points are found from the masks point by point, as docs/schemes.md words the rules for sharpness, boundaries and
/// sectors, with none of the product's configurations, stencils or tables. Around a vertex that is not manifold (also
/// at the rim of a cut-out) points are those of a corner. O(size).
Refined refine(const TaggedMesh& mesh, const SubdivisionRules& rules, const SchemeMasks& masks);

}  // namespace shaolin
