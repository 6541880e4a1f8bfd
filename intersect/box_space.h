#pragma once
/// Many boxes against one ray, in single precision, rounded outward.
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "box.h"
#include "eight.h"

namespace shaolin {

/// The coordinates that a scene's boxes are tested in: about the scene's middle, in units of about half its extent, so
/// that single precision resolves them wherever the scene is and whatever its size.
struct BoxSpace {
  Vec3 centre = Vec3::Zero();
  double scale = 1;  ///< a power of two

  BoxSpace() = default;
  explicit BoxSpace(const Box& scene);

  Vec3 operator()(const Vec3& point) const { return scale * (point - centre); }
};

/// A box in a scene's coordinates. A bound b is moved outward by 4 |b| v, with v = 2^-24, and rounded outward: what a
/// ray's test costs in roundings of it (see BoxRay).
struct SceneBox {
  float bounds[2][3];  ///< [lower, upper][axis]

  SceneBox() = default;
  SceneBox(const Box& box, const BoxSpace& space);

  /// A box in the object's coordinates that holds what this one does. Powers of two take single numbers exactly; the
  /// sum with the middle rounds, by less than what the bounds were moved outward unless the middle is far off.
  Box in_object(const BoxSpace& space) const {
    const auto side = [&](const float(&b)[3]) -> Vec3 { return Vec3(b[0], b[1], b[2]) / space.scale + space.centre; };
    const Box box{side(bounds[0]), side(bounds[1])};
    return box.grown(2 * unit_roundoff * box.largest_coordinate());
  }

  void add(const SceneBox& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[0][axis] = std::min(bounds[0][axis], box.bounds[0][axis]);
      bounds[1][axis] = std::max(bounds[1][axis], box.bounds[1][axis]);
    }
  }
};

/// Eight boxes side by side, so that one pass of vector instructions tests them all.
struct alignas(32) EightBoxes {
  float bounds[2][3][8];  ///< [lower, upper][axis][box]

  /// Empty boxes; no ray meets one.
  EightBoxes();
  void set(std::size_t i, const SceneBox& box) {
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t axis = 0; axis < 3; ++axis) bounds[side][axis][i] = box.bounds[side][axis];
  }
  /// A box that holds all.
  SceneBox bound() const;
  SceneBox box(std::size_t i) const {
    SceneBox box;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t axis = 0; axis < 3; ++axis) box.bounds[side][axis] = bounds[side][axis][i];
    return box;
  }
  bool is_empty(std::size_t i) const { return bounds[0][0][i] > bounds[1][0][i]; }
};

/// A ray in a scene's coordinates, in single precision. Distances count from a place on it, which should be near the
/// scene.
///
/// A plane x = b is met at b inverse + c, c = -x inverse for a ray counted from x. The factor, the product, c and the
/// sum are each rounded once, which moves the distance by at most (3 |b| + 2 |x|) |inverse| v to first order. The boxes
/// take care of the first term. For the second, entries are moved forward by 4 |x| |inverse| v, exits back; what is
/// left over covers the double roundings of x, and 8 u of the origin those of a start far away. A direction component
/// below 1e-18 moves the ray by far less over the few units to cross, so it is replaced by that: no infinity meets a
/// zero.
class BoxRay {
 public:
  /// `start` is the distance along the ray that others count from.
  BoxRay(const TraversalRay& ray, const BoxSpace& space, double start) : start_(start), scale_(space.scale) {
    const double near = (ray.near - start_) * scale_;
    begin_ = static_cast<float>(near * (near < 0 ? 1 + 0x1p-22 : 1 - 0x1p-22));
    const Vec3 origin = space(ray.origin), at = origin + (start_ * scale_) * ray.direction;
    const double own_error = 8 * unit_roundoff * origin.cwiseAbs().maxCoeff();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      constexpr double least = 1e-18;
      const double d = std::copysign(std::max(std::abs(ray.direction[i]), least), ray.direction[i]);
      const double inverse = 1 / d, x = at[i];
      const double pad = (0x1p-22 * std::abs(x) + own_error) * std::abs(inverse);
      inverse_[axis] = static_cast<float>(inverse);
      entry_[axis] = static_cast<float>(-x * inverse - pad);
      exit_[axis] = static_cast<float>(-x * inverse + pad);
      entered_at_[axis] = d < 0;
    }
  }

  /// A distance along the ray in this ray's units, moved on by more than rounding may take from it.
  float local(double distance) const {
    const double value = (distance - start_) * scale_;
    return static_cast<float>(value * (value < 0 ? 1 - 0x1p-22 : 1 + 0x1p-22));
  }

  /// True if the ray meets the box no nearer than it may, and before `far`.
  bool meets(const SceneBox& box, float far) const {
    float entry = begin_, exit = far;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t first = entered_at_[axis];
      entry = std::max(entry, box.bounds[first][axis] * inverse_[axis] + entry_[axis]);
      exit = std::min(exit, box.bounds[1 - first][axis] * inverse_[axis] + exit_[axis]);
    }
    return entry <= exit;
  }

  /// Those of eight boxes that the ray meets, as bits; where it enters each.
  unsigned meet(const EightBoxes& boxes, float far, std::array<float, 8>& entries) const {
    Eight entry(begin_), exit(far);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Eight inverse(inverse_[axis]);
      const std::size_t first = entered_at_[axis];
      entry = larger(Eight(boxes.bounds[first][axis]) * inverse + Eight(entry_[axis]), entry);
      exit = smaller(Eight(boxes.bounds[1 - first][axis]) * inverse + Eight(exit_[axis]), exit);
    }
    entry.store(entries.data());
    return at_most(entry, exit);
  }

 private:
  double start_, scale_;
  float begin_;
  std::array<float, 3> inverse_, entry_, exit_;
  std::array<std::uint8_t, 3> entered_at_;
};

/// A box that a ray meets, and at what distance: one number, the less the nearer the box.
class MetBox {
 public:
  MetBox() = default;
  MetBox(float distance, std::int32_t what)
      : key_(std::uint64_t{ordered(std::bit_cast<std::uint32_t>(distance))} << 32 | static_cast<std::uint32_t>(what)) {}

  float distance() const { return std::bit_cast<float>(unordered(static_cast<std::uint32_t>(key_ >> 32))); }
  std::int32_t what() const { return static_cast<std::int32_t>(key_); }

  friend void put_in_order(MetBox& nearer, MetBox& farther) {
    const std::uint64_t a = nearer.key_, b = farther.key_;
    nearer.key_ = a < b ? a : b;
    farther.key_ = a < b ? b : a;
  }

 private:
  static constexpr std::uint32_t sign = 0x80000000;
  /// Bits of floats as numbers in the same order: of negative ones all are turned, of others the sign.
  static std::uint32_t ordered(std::uint32_t bits) { return bits ^ ((bits & sign) != 0 ? ~0U : sign); }
  static std::uint32_t unordered(std::uint32_t bits) { return bits ^ ((bits & sign) != 0 ? sign : ~0U); }

  std::uint64_t key_;
};

/// Those of up to sixteen boxes that a ray meets, nearest first, with the distances (in the ray's units) at which it
/// enters.
class BoxOrder {
 public:
  BoxOrder() = default;
  BoxOrder(const EightBoxes& boxes, const BoxRay& ray, float far) { add(boxes, 0, ray, far); }

  /// Eight boxes, numbered from `first` on. Which is nearer is for no branch to guess: each goes past all that are
  /// there, the nearer of two staying.
  void add(const EightBoxes& boxes, std::size_t first, const BoxRay& ray, float far) {
    alignas(32) std::array<float, 8> entries;
    for (unsigned met = ray.meet(boxes, far, entries); met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      MetBox farther(entries[i], static_cast<std::int32_t>(first + i));
      for (std::size_t at = 0; at < count_; ++at) put_in_order(met_[at], farther);
      met_[count_++] = farther;
    }
  }

  std::size_t count() const { return count_; }
  std::size_t box(std::size_t i) const { return static_cast<std::size_t>(met_[i].what()); }
  float distance(std::size_t i) const { return met_[i].distance(); }

 private:
  std::size_t count_ = 0;
  std::array<MetBox, 16> met_;
};

}  // namespace shaolin
