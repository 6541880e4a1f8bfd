#pragma once
/// The plane TP that a patch is projected to.
#include <optional>
#include <type_traits>
#include <vector>

#include "../schemes/corner_limit.h"
#include "../schemes/mesh.h"

namespace shaolin {

/// The unit normal of TP: of the plane through the corners' limit points (section 8.2 of the paper for quads). A corner
/// whose limit masks do not apply yet lends its control point. Zero if the corners span no plane.
template <Scheme S>
Vec3 chord_plane_normal(const Patch<S>& patch) {
  std::vector<Vec3> corners;
  const FaceSides& face = patch.configuration->neighbourhood().face;  // it may repeat a vertex
  for (int k = 0; k < face.size(); ++k) {
    const std::optional<LimitAtCorner> limit = corner_limit(patch, k);
    corners.push_back(limit ? limit->position : patch.points[static_cast<std::size_t>(face.vertex(k))]);
  }
  using Base = std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh>;
  return Base::chord_normal(corners);
}

}  // namespace shaolin
