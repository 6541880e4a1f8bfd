#pragma once
// The slab test of one box, slowly: the twin of BoxOrder.
#include <algorithm>
#include <limits>
#include <vector>

#include "intersect/box.h"
#include "tests/random.h"

namespace shaolin {

enum class Meets { no, maybe, yes };

/// Does the ray meet the closed box within [near, far]? Divides in long double, whose roundings, 2^-64 where it has 64
/// bits, are lost in the 2^-53 that BoxOrder has to spare. The answer is `maybe` where moving the box's ends by 8 u of
/// their distance decides it: BoxOrder may move them by 4 u and rounds three times itself.
inline Meets slowly_meets(const Box& box, const TraversalRay& ray, double far) {
  using Long = long double;
  Long entry = -std::numeric_limits<Long>::infinity(), exit = std::numeric_limits<Long>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Long origin = ray.origin[axis], direction = ray.direction[axis];
    const Long lower = box.lower[axis], upper = box.upper[axis];
    if (!(lower <= upper)) return Meets::no;
    if (direction == 0) {
      if (origin < lower || origin > upper) return Meets::no;
      continue;
    }
    const Long a = (lower - origin) / direction, b = (upper - origin) / direction;
    entry = std::max(entry, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  const auto meets = [&](Long slack) {
    const Long first = std::isfinite(entry) ? entry - slack * std::abs(entry) : entry;
    const Long last = std::isfinite(exit) ? exit + slack * std::abs(exit) : exit;
    return first <= last && Long(ray.near) <= last && first <= Long(far);
  };
  return meets(0) ? Meets::yes : meets(8 * Long(unit_roundoff)) ? Meets::maybe : Meets::no;
}

/// A coordinate of few bits: those of boxes, origins and targets coincide often, as they do in modelled shapes.
inline double round_number(Random& random) { return 0.25 * (random.index(17) - 8); }

inline Vec3 round_point(Random& random) {
  const double x = round_number(random), y = round_number(random);
  return {x, y, round_number(random)};
}

/// A box between two points; often flat, an edge or a point.
inline Box round_box(Random& random) {
  Box box;
  box.add(round_point(random));
  box.add(round_point(random));
  return box;
}

/// A ray of any interval, half of them with zeros in the direction, of either sign, or along faces, edges and corners.
inline Ray round_ray(Random& random) {
  Ray ray{round_point(random), random.direction()};
  if (random.index(2) == 0) {
    do ray.direction = round_point(random);
    while (ray.direction.isZero(0));
    for (double& d : ray.direction)
      if (d == 0 && random.index(2) == 0) d = -0.0;
  }
  if (random.index(4) == 0) ray.tmin = random.uniform(-1, 1);
  if (random.index(4) == 0) ray.tmax = random.uniform(0, 2);
  return ray;
}

}  // namespace shaolin
