#pragma once
/// Axis-aligned boxes and the slab test.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "four.h"
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
  double near, far;
  std::array<std::uint8_t, 3> entered_at;  ///< per axis: 0 if the ray comes to a box's lower bound first, 1 if upper

  explicit TraversalRay(const Ray& ray) : origin(ray.origin) {
    // Scale first, by a power of two: the square of a tiny or huge direction would underflow or overflow, and so may
    // the length itself.
    scale_ = std::scalbn(1.0, std::ilogb(ray.direction.cwiseAbs().maxCoeff()));
    const Vec3 scaled = ray.direction / scale_;
    scaled_length_ = scaled.norm();
    direction = scaled.normalized();
    // A component that has no inverse moves the ray by 2e-308 of its way: far below the rounding of any coordinate.
    direction = (direction.array().abs() < std::numeric_limits<double>::min()).select(0.0, direction);
    inverse = direction.cwiseInverse();
    for (std::size_t axis = 0; axis < 3; ++axis) entered_at[axis] = inverse[static_cast<Eigen::Index>(axis)] < 0;
    near = ray.tmin * scaled_length_ * scale_;
    far = ray.tmax * scaled_length_ * scale_;
  }

  /// A distance in units of the given direction's length.
  double t(double distance) const { return distance / scaled_length_ / scale_; }
  /// The length of the given direction; infinite where it overflows.
  double length() const { return scaled_length_ * scale_; }

 private:
  double scale_, scaled_length_;
};

/// Four boxes side by side, so that one pass of vector instructions tests them all.
struct FourBoxes {
  double bounds[2][3][4];  ///< [lower, upper][axis][box]

  /// Empty boxes; no ray meets one.
  FourBoxes() {
    for (std::size_t i = 0; i < 4; ++i) set(i, Box());
  }
  void set(std::size_t i, const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[0][axis][i] = box.lower[static_cast<Eigen::Index>(axis)];
      bounds[1][axis][i] = box.upper[static_cast<Eigen::Index>(axis)];
    }
  }
};

/// Those of four boxes that a ray meets, nearest first, with the distances at which it enters them.
class BoxOrder {
 public:
  /// Boxes that meet the ray within [ray.near, far]. Conservative if the boxes were rounded outward: a slab's end
  /// carries three roundings, and is moved out by 4 u of its value. A direction component of 0 gives infinite or
  /// undefined ends; an undefined end constrains nothing, and an infinite end on the wrong side becomes undefined and
  /// is no hit.
  BoxOrder(const FourBoxes& boxes, const TraversalRay& ray, double far) {
    Four entry(-missed), exit(missed);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<Eigen::Index>(axis);
      const Four origin(ray.origin[at]), inverse(ray.inverse[at]);
      const std::size_t first = ray.entered_at[axis];
      entry = larger((Four(boxes.bounds[first][axis]) - origin) * inverse, entry);
      exit = smaller((Four(boxes.bounds[1 - first][axis]) - origin) * inverse, exit);
    }
    const Four slack(4 * unit_roundoff);
    entry = entry - slack * abs(entry);
    exit = exit + slack * abs(exit);
    const int met = at_most(entry, exit) & at_most(Four(ray.near), exit) & at_most(entry, Four(far));
    if (met == 0) return;
    std::array<double, 4> value;
    entry.store(value.data());
    sort(static_cast<unsigned>(met), value);
  }

  int count() const { return count_; }
  std::size_t box(int i) const { return box_[static_cast<std::size_t>(i)]; }
  double distance(int i) const { return distance_[static_cast<std::size_t>(i)]; }

 private:
  static constexpr double missed = std::numeric_limits<double>::infinity();

  void sort(unsigned met, const std::array<double, 4>& value) {
    int count = 0;
    for (; met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      auto at = static_cast<std::size_t>(count++);
      for (; at > 0 && distance_[at - 1] > value[i]; --at) {
        distance_[at] = distance_[at - 1];
        box_[at] = box_[at - 1];
      }
      distance_[at] = value[i];
      box_[at] = static_cast<std::uint8_t>(i);
    }
    count_ = count;
  }

  int count_ = 0;
  std::array<std::uint8_t, 4> box_;
  std::array<double, 4> distance_;
};

}  // namespace shaolin
