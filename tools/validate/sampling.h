#pragma once
/// Where a surface is looked at: parameters that crowd towards corners, and rays of several kinds.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "intersect/ray.h"
#include "schemes/limit_surface.h"
#include "tools/validate/oracle.h"

namespace shaolin {

/// A surface to look at: an oracle's, or the product's own where that is not what is checked.
struct SampledSurface {
  int face_count;
  bool triangular;
  std::function<bool(int)> has_limit;
  std::function<int(int)> sub_count;
  std::function<std::optional<LimitSample>(const SurfaceParameter&)> evaluate;
  std::function<bool(const SurfaceParameter&)> is_inside;  ///< see Oracle::is_inside(); may be false where not known

  /// They must outlive the result.
  static SampledSurface of(const Oracle& oracle);
  static SampledSurface of(const LimitSurface& surface);
};

/// Faces with a limit surface and their subs, each as likely; u and v uniform, but a quarter of them at distances from
/// a random corner of the domain (in the largest of |du|, |dv|) that are log-uniform from 1 down to 1e-8. Of that
/// quarter one in sixteen is the corner itself, one in sixteen lies on a side, and one in sixteen is from 1e-8 to 1e-35
/// away. Empty if no face has a limit surface.
std::vector<SurfaceParameter> sample_parameters(const Oracle& oracle, std::size_t count, std::uint64_t seed);

enum class RayKind {
  camera,      ///< from a sphere around the model to points of its box
  incoherent,  ///< origins in a box half as large again, any direction; every fourth with a finite interval
  grazing,     ///< through a surface point, 1e-4 to 1e-1 rad out of its tangent plane
  aimed        ///< at a corner of a patch or a point of its sides, exactly
};
inline constexpr std::array<RayKind, 4> ray_kinds{RayKind::camera, RayKind::incoherent, RayKind::grazing,
                                                  RayKind::aimed};
const char* name_of(RayKind kind);

struct ProbeRay {
  RayKind kind;
  Ray ray;
  std::optional<double> target;    ///< where the ray meets the surface by construction; a nearer hit may exist
  bool crosses_at_target = false;  ///< there it goes through the surface, at more than 1e-2 rad, and cannot miss
};

/// `count` rays, in thirds camera, incoherent and grazing, and a tenth of that in addition aimed. Directions have
/// lengths of several orders of magnitude. The model's box is that of the surface, not of its control points, which may
/// be far away. Empty if no face has a limit surface.
std::vector<ProbeRay> sample_rays(const SampledSurface& surface, std::size_t count, std::uint64_t seed);
std::vector<ProbeRay> sample_rays(const Oracle& oracle, std::size_t count, std::uint64_t seed);

}  // namespace shaolin
