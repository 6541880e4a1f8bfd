#pragma once
/// Faces whose configuration the valences of their corners tell.
#include <array>
#include <optional>
#include <vector>

#include "mesh.h"

namespace shaolin {

/// A face that is plain: of the split's own kind, like all faces around its corners, which are inner vertices without
/// tags, and none of the vertices around it stands in two places. All such faces whose corners have equal valences look
/// alike, so that most patches of a mesh need no walk over its rings and no key (canonical_form()).
struct PlainFace {
  std::array<int, 4> valences;  ///< of the corners in order; of a triangle the last is 0
  std::vector<int> vertices;    ///< in the order of canonical_form()
};

/// The face seen from one of its corners; empty if it is not plain, or has corners of 16 faces and more. For schemes of
/// radius 1. O(sum of the valences).
std::optional<PlainFace> plain_face(const Mesh& mesh, Mesh::Corner corner);

}  // namespace shaolin
