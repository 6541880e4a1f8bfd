#pragma once
/// Shapes to ask a scene with, in the world's space: all are solid and convex, and hold their boundary.
#include <variant>
#include <vector>

#include "../schemes/vec3.h"

namespace shaolin {

struct Sphere {
  Vec3 centre;
  double radius;  ///< above 0
};

/// A box that may be turned.
struct OrientedBox {
  Vec3 centre;
  Vec3 half;                                           ///< half its extents along its axes, >= 0
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: unit, at right angles
};

/// All points within a radius of a segment, which may be a point.
struct Capsule {
  Vec3 a, b;
  double radius;  ///< above 0
};

/// A flat piece, without an inside; it may be a segment or a point.
struct Triangle {
  Vec3 a, b, c;
};

using Shape = std::variant<Sphere, OrientedBox, Capsule, Triangle>;

/// The points x with normal . x <= offset.
struct HalfSpace {
  Vec3 normal;  ///< of any length but 0
  double offset;
};

/// A sphere that moves by a displacement, without turning back: at t in [0, 1] its centre is start + t displacement.
struct SphereSweep {
  Vec3 start;
  double radius;  ///< above 0
  Vec3 displacement;
};

/// What is in all of a few half-spaces; it may be empty, and it may reach without end.
struct Frustum {
  std::vector<HalfSpace> sides;

  /// What an eye sees through a convex polygon whose corners lie in directions d0, d1, ... in turn, either way round:
  /// the points e + s d for d in the hull of the directions and s >= 0. Throws InputError for less than three
  /// directions, and where neighbouring ones span no plane.
  static Frustum of_view(const Vec3& eye, const std::vector<Vec3>& corners);
};

}  // namespace shaolin
