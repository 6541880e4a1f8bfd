#pragma once
/// An instance's transform, prepared for rays, points and hits.
#include <optional>

#include "affine.h"
#include "box.h"

namespace shaolin {

/// Rays go into the object's space, hits come back. A ray's direction keeps the length that the map gives it, so that t
/// is the same number in both spaces.
class Placement {
 public:
  /// Throws InputError as inverse() does.
  explicit Placement(const Affine& to_world);

  /// The identity leaves every bit of a ray and a hit as it is.
  bool is_identity() const { return identity_; }
  const Affine& to_world() const { return to_world_; }

  /// The ray in the object's space; empty if it leaves the range of doubles there.
  std::optional<Ray> to_object(const Ray& ray) const;

  /// A point in the object's space, rounded; not finite if it leaves the range of doubles there.
  Vec3 to_object(const Vec3& point) const {
    return identity_ ? point : Vec3(to_object_ * (point - to_world_.translation()));
  }
  /// An upper triangular R under which vectors have the lengths of their images: |R x| = |linear() x|.
  const Eigen::Matrix3d& metric() const { return metric_; }

  /// Position and derivatives go with the map. The normal goes with the inverse transpose, so it stays on its side of
  /// the surface: what was outside is outside. Where the map mirrors, it is thus against du x dv.
  void to_world(LimitSample& sample) const;

  /// A hit of the ray in the world: its sample goes with the map, its certificate's error with the map's norm.
  void to_world(Hit& hit, const TraversalRay& ray) const;

 private:
  Affine to_world_;
  Eigen::Matrix3d to_object_, normals_;  ///< of directions; of normals, up to a positive factor
  Eigen::Matrix3d metric_ = Eigen::Matrix3d::Identity();
  bool identity_;
};

}  // namespace shaolin
