#pragma once
/// Axis-aligned boxes and the slab test.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

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
  /// Each side moved out by that share of the box's extent.
  Box expanded(double share) const {
    if (share == 0) return *this;
    const Vec3 margin = share * (upper - lower);
    return {lower - margin, upper + margin};
  }
  Box grown(double slack) const { return {lower - Vec3::Constant(slack), upper + Vec3::Constant(slack)}; }
  /// What rounding may take from the hull of control points in the box: the part of RayFrame::error() that comes with
  /// them, derived there. A box test must not be stricter than the tests of projected points.
  double rounding() const { return 160 * unit_roundoff * largest_coordinate(); }
  Box with_rounding() const { return grown(rounding()); }
  Vec3 centre() const { return 0.5 * lower + 0.5 * upper; }
  double half_area() const {
    const Vec3 e = upper - lower;
    return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
  }
  double largest_coordinate() const { return std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff()); }
};

/// The bounds of points.
inline Box hull_of(std::span<const Vec3> points) {
  Vec3 lower = Box().lower, upper = Box().upper;  // of their own, to stay in registers
  for (const Vec3& point : points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return {lower, upper};
}

/// The largest power of two that is not above x, positive and finite. (Of a normal number, what its exponent says.)
inline double power_of_two_below(double x) {
  if (x < std::numeric_limits<double>::min()) return std::scalbn(1.0, std::ilogb(x));
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & exponent);
}

/// A ray prepared for traversal: unit direction, distances in place of t.
struct TraversalRay {
  Vec3 origin, direction;
  double near, far;

  explicit TraversalRay(const Ray& ray) : origin(ray.origin) {
    // The square of a tiny or huge direction would underflow or overflow, and so may the length itself: such a one is
    // scaled first, by a power of two.
    constexpr double tiny = 0x1p-400, huge = 0x1p400;
    const double largest = ray.direction.cwiseAbs().maxCoeff();
    Vec3 scaled = ray.direction;
    if (largest < tiny || largest > huge) {
      scale_ = power_of_two_below(largest);
      scaled /= scale_;
    }
    scaled_length_ = scaled.norm();
    direction = scaled / scaled_length_;
    // A component that is no normal number moves the ray by 2e-308 of its way: far below the rounding of any
    // coordinate.
    direction = (direction.array().abs() < std::numeric_limits<double>::min()).select(0.0, direction);
    near = ray.tmin * scaled_length_ * scale_;
    far = ray.tmax * scaled_length_ * scale_;
    // Along a tiny direction t overflows: what no number says is no hit.
    if (const double reach = std::numeric_limits<double>::max() * scale_ * scaled_length_; reach < 1e30) {
      near = std::max(near, -reach);
      far = std::min(far, reach);
    }
  }

  /// A distance in units of the given direction's length.
  double t(double distance) const { return distance / scaled_length_ / scale_; }
  /// The distance of a t.
  double distance(double t) const { return t * scaled_length_ * scale_; }
  /// The length of the given direction; infinite where it overflows.
  double length() const { return scaled_length_ * scale_; }

 private:
  double scale_ = 1, scaled_length_;
};

/// The distance at which a ray enters a box, or empty unless it meets it within [ray.near, far]. Conservative if the
/// box was rounded outward: a slab's end carries two roundings, and is moved out by 4 u of its value. A direction
/// component of 0 gives infinite or undefined ends; an undefined end constrains nothing, and an infinite end on the
/// wrong side becomes undefined and is no hit.
inline std::optional<double> entry_distance(const Box& box, const TraversalRay& ray, double far) {
  double entry = -std::numeric_limits<double>::infinity(), exit = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const bool lower_first = !std::signbit(ray.direction[axis]);
    const double first = ((lower_first ? box.lower : box.upper)[axis] - ray.origin[axis]) / ray.direction[axis];
    const double last = ((lower_first ? box.upper : box.lower)[axis] - ray.origin[axis]) / ray.direction[axis];
    entry = first > entry ? first : entry;
    exit = last < exit ? last : exit;
  }
  entry -= 4 * unit_roundoff * std::abs(entry);
  exit += 4 * unit_roundoff * std::abs(exit);
  if (entry <= exit && ray.near <= exit && entry <= far) return entry;
  return {};
}

}  // namespace shaolin
