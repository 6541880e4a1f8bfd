#pragma once
/// Axis-aligned boxes and the slab test.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ray.h"

namespace shaolin {

/// Half an ulp of 1: the largest relative error of one rounding.
inline constexpr double unit_roundoff = 0x1p-53;

struct Box {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void add(const Box& box) {
    lower = lower.cwiseMin(box.lower);
    upper = upper.cwiseMax(box.upper);
  }
  Vec3 centre() const { return 0.5 * lower + 0.5 * upper; }
  double half_area() const {
    const Vec3 e = upper - lower;
    return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
  }
  double largest_coordinate() const { return std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff()); }
};

/// A ray prepared for traversal: unit direction, distances in place of t.
struct TraversalRay {
  Vec3 origin, direction, inverse;
  double length;  ///< of the given direction: distance = t * length
  double near, far;

  explicit TraversalRay(const Ray& ray) : origin(ray.origin) {
    // Scale first: the square of a tiny or huge direction would underflow or overflow.
    const double scale = ray.direction.cwiseAbs().maxCoeff();
    const Vec3 scaled = ray.direction / scale;
    length = scaled.norm() * scale;
    direction = scaled.normalized();
    inverse = direction.cwiseInverse();
    near = ray.tmin * length;
    far = ray.tmax * length;
  }
};

/// What entry_distance() says of a box that the ray passes.
inline constexpr double missed = std::numeric_limits<double>::infinity();

/// The distance at which the ray enters the box, or `missed` if it does not meet it within [ray.near, far].
/// Conservative: the box's faces were rounded outward by the caller, and both ends of every slab carry three roundings,
/// so the interval is widened by 4 u of its larger end. A direction component of 0 gives an infinite or undefined slab
/// end; comparisons are written so that an undefined one constrains nothing.
inline double entry_distance(const Box& box, const TraversalRay& ray, double far) {
  double entry = -std::numeric_limits<double>::infinity();
  double exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const bool negative = ray.inverse[axis] < 0;
    const double enter = ((negative ? box.upper : box.lower)[axis] - ray.origin[axis]) * ray.inverse[axis];
    const double leave = ((negative ? box.lower : box.upper)[axis] - ray.origin[axis]) * ray.inverse[axis];
    entry = enter > entry ? enter : entry;
    exit = leave < exit ? leave : exit;
  }
  // One end is infinite if the ray runs beside a slab (then entry > exit) or within all but undefined ones.
  const double slack = 4 * unit_roundoff * std::max(std::abs(entry), std::abs(exit));
  if (!std::isinf(slack)) {
    entry -= slack;
    exit += slack;
  }
  return entry <= exit && exit >= ray.near && entry <= far ? entry : missed;
}

}  // namespace shaolin
