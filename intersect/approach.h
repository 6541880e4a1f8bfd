#pragma once
/// A ray on its way through a scene, as a finish sees it.
#include "box_space.h"
#include "counters.h"

namespace shaolin {

/// What a query looks for: the closest hit, any, or all.
enum class Query { closest, any, all };

/// A ray, how far it looks, and where its work is counted.
class Approach {
 public:
  Approach(const TraversalRay& along, const BoxRay& among, const Footprint& width, const BoxSpace& boxes,
           RayCounters& count)
      : ray(along), box_ray(among), footprint(width), space(boxes), counters(count), far_(along.far) {}

  const TraversalRay& ray;
  const BoxRay& box_ray;
  const Footprint& footprint;
  const BoxSpace& space;
  RayCounters& counters;

  /// The distance past which nothing is of interest: the ray's, or that of the nearest hit.
  double far() const { return far_; }
  /// The same in the box ray's units.
  float box_far() const { return box_far_; }
  bool far_is_hit() const { return far_ < ray.far; }

  void shorten(double distance) {
    far_ = std::min(far_, distance);
    box_far_ = box_ray.local(far_);
  }

 private:
  double far_;
  float box_far_ = box_ray.local(far_);
};

}  // namespace shaolin
