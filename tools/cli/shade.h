#pragma once
/// The picture's colours: lights with shadows, a soft fill, mirrors.
#include <array>

#include "intersect/scene.h"
#include "tools/cli/camera.h"
#include "tools/cli/look.h"

namespace shaolin {

/// The light of pictures that have no other: beside the camera, up and to the left.
PointLight key_light(const View& view);

/// Shades hits of one scene, seen in one view. Without lights, a key light stands beside the camera, up and to the
/// left; a fill from all around, brighter from above, keeps shadows from being black. Both sides of the surface look
/// the same.
class Shader {
 public:
  /// A ray is reflected this often; the mirror after that shows its own colour alone.
  static constexpr int most_reflections = 4;

  /// `scene` must outlive the shader; `options` are those that its objects were made with. Where rays meet chord faces,
  /// another ray meets others, nearer or farther by what the criteria allow: shadow and mirror rays meet nothing until
  /// they are so far off the surface.
  Shader(const Scene& scene, const View& view, Look look = {}, const SceneOptions& options = {});

  /// Linear colour of the surface at a hit of `ray`; casts at most one shadow ray for each light there and wherever its
  /// reflection leads. May be called concurrently.
  std::array<float, 3> shade(const Ray& ray, const Hit& hit) const;

 private:
  /// A point of the surface as a ray sees it.
  struct Seen {
    Vec3 position;
    Vec3 normal;    ///< on the side of the surface that is seen
    double facing;  ///< the cosine between the normal and the way back along the ray
    double width;   ///< of the ray's footprint
    double curvature;

    Seen(const Ray& ray, const Hit& hit);
  };

  Vec3 color(const Ray& ray, const Hit& hit, int reflections_left) const;
  Vec3 reflection(const Ray& ray, const Seen& seen, int reflections_left) const;
  /// The light from all around that comes against a direction.
  Vec3 fill(const Vec3& direction) const;
  bool lit(const PointLight& light, const Seen& seen) const;
  /// A shadow's or mirror's ray: from the surface along a direction, where t is 0 at the surface.
  Ray leaving(const Seen& seen, const Vec3& direction) const;

  const Scene& scene_;
  Look look_;  ///< with the key light, if there are no others
  Vec3 up_;
  double offset_;                      ///< rays from a surface start this far off it
  double tolerance_ = 0, pixels_ = 0;  ///< how far chord faces are off it: see leaving()
};

}  // namespace shaolin
