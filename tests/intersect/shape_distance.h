#pragma once
// How far a point is from a shape, by formulas of their own: they share nothing with the searches that they check.
#include <algorithm>
#include <variant>

#include "intersect/shapes.h"

namespace shaolin {

inline double distance_from_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length = (b - a).norm();
  if (length == 0) return (p - a).norm();
  const Vec3 unit = (b - a) / length;
  return (p - a - std::clamp(unit.dot(p - a), 0.0, length) * unit).norm();
}

/// 0 where the shape holds the point.
inline double distance_from(const Sphere& s, const Vec3& p) { return std::max(0.0, (p - s.centre).norm() - s.radius); }
inline double distance_from(const OrientedBox& box, const Vec3& p) {
  Vec3 beyond;
  for (Eigen::Index i = 0; i < 3; ++i)
    beyond[i] = std::max(0.0, std::abs(box.axes.col(i).dot(p - box.centre)) - box.half[i]);
  return beyond.norm();
}
inline double distance_from(const Capsule& c, const Vec3& p) {
  return std::max(0.0, distance_from_segment(p, c.a, c.b) - c.radius);
}
/// Over the inside by the signs of areas, else from the edges.
inline double distance_from(const Triangle& t, const Vec3& p) {
  const Vec3 corners[3] = {t.a, t.b, t.c};
  const Vec3 normal = (t.b - t.a).cross(t.c - t.a);
  bool is_over = normal.norm() > 0;
  double least = std::min(
      {distance_from_segment(p, t.a, t.b), distance_from_segment(p, t.b, t.c), distance_from_segment(p, t.c, t.a)});
  for (int i = 0; i < 3; ++i) is_over &= normal.dot((corners[(i + 1) % 3] - corners[i]).cross(p - corners[i])) > 0;
  return is_over ? std::min(least, std::abs(normal.normalized().dot(p - t.a))) : least;
}
inline double distance_from(const Shape& shape, const Vec3& p) {
  return std::visit([&](const auto& one) { return distance_from(one, p); }, shape);
}

}  // namespace shaolin
