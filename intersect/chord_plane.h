#pragma once
/// The plane TP of Mueller et al. 2003, section 6: of a patch's chord face.
#include <type_traits>
#include <vector>

#include "../schemes/corner_limit.h"
#include "../schemes/mesh.h"

namespace shaolin {

/// The normal of TP: of the plane through the corners' limit points (section 8.2 for quads), unit, or zero where they
/// span no plane. A corner whose limit masks do not apply yet lends its control point; the plane only serves to orient
/// RP and CP.
template <Scheme S>
Vec3 plane_normal(const Patch<S>& patch) {
  std::vector<Vec3> corners;
  for (int k = 0; k < patch.configuration->corner_count(); ++k) {
    const std::optional<LimitAtCorner> limit = corner_limit(patch, k);
    corners.push_back(limit ? limit->position : patch.points[static_cast<std::size_t>(k)]);
  }
  using Base = std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh>;
  return Base::chord_normal(corners);
}

}  // namespace shaolin
