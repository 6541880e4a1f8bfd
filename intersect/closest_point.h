#pragma once
/// The point of the limit surfaces that is closest to a given one.
#include <limits>

#include "../schemes/limit_sample.h"

namespace shaolin {

class Placement;

/// What a closest-point query answers, in the world's space.
struct ClosestPoint {
  double distance = 0;
  SurfaceParameter at;  ///< face, sub, u, v in the input's terms
  LimitSample sample;   ///< the limit position, the unit normal, derivatives
  int level = 0;     ///< the refinement level of the piece that was asked last: its parameter square has side 2^-level
  int instance = 0;  ///< the index of the instance in its scene
};

/// The question as it reaches an object: what lies within a distance of a point, both of the world's space, of the
/// object that stands there by a placement.
struct PointQuery {
  Vec3 point;
  const Placement& placement;
  double radius = std::numeric_limits<double>::infinity();
};

}  // namespace shaolin
