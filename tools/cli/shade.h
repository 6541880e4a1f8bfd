#pragma once
/// The picture's light: a key light with shadows, and a soft fill.
#include <array>

#include "intersect/scene.h"
#include "tools/cli/camera.h"

namespace shaolin {

/// Shades hits of one scene, seen in one view. A key light stands beside the camera, up and to the left; a fill from
/// all around, brighter from above, keeps shadows from being black. Both sides of the surface look the same.
class Shader {
 public:
  /// `scene` must outlive the shader.
  Shader(const Scene& scene, const View& view);

  /// Linear colour of the surface at a hit of `ray`; casts at most one shadow ray. May be called concurrently.
  std::array<float, 3> shade(const Ray& ray, const Hit& hit) const;

 private:
  /// `normal` looks to the side of the surface that is lit.
  bool lit(const Vec3& position, const Vec3& normal) const;

  const Scene& scene_;
  Vec3 light_;  ///< the key light's position
  Vec3 up_;
  double shadow_offset_;  ///< shadow rays start this far off the surface
};

}  // namespace shaolin
