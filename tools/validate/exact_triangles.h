#pragma once
/// Decisions about rays and triangles, made anew in exact arithmetic.
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "schemes/control_mesh.h"
#include "tools/validate/check_rays.h"

namespace shaolin {

/// Triangles as Method::uniform has them: the same doubles, the same corners.
struct TriangleSoup {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};
/// The facets of `level` refinements, quads cut from corner 0 to 2. Empty unless the scheme is loop or catmark. Throws
/// what tessellate() throws.
TriangleSoup uniform_triangles(const ControlMesh& mesh, const std::string& scheme, int level);

/// What came of the rays.
struct ExactTriangleFigures {
  std::size_t rays = 0, hits = 0;  ///< hits: by exact decision
  std::size_t decisions = 0;       ///< of a ray and a triangle whose boxes meet
  std::size_t excused = 0;         ///< rays within rounding of an outline or a boundary, decided otherwise than exactly
  double worst_t = 0;              ///< of hits: from our t to the exact one, over |t| |d| + the mesh's diagonal
  std::vector<Disagreement> disagreements;
};

/// Decides for each ray which triangles it meets, by the signs of exact determinants of the doubles that were given
/// (CGAL's exact kernel; no point on the ray is rounded), and holds the answers of `ours`, a scene by Method::uniform
/// at that level, against it.
///
/// A ray is lost if it meets a triangle, inside or on its rim, and ours finds nothing, or only what is farther; a ghost
/// if ours finds what is not there. Doubles may put a ray on the other side of an edge where it passes within rounding;
/// that is excused only where there is no surface on that side: at a boundary, or an outline, whose two triangles are
/// seen from different sides. O(rays x triangles).
ExactTriangleFigures check_exact_triangles(const Intersector& ours, const TriangleSoup& soup,
                                           std::span<const ProbeRay> rays);

}  // namespace shaolin
