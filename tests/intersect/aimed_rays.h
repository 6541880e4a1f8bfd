#pragma once
// Rays aimed at points of the limit surface, and what must be true of their hits.
#include <array>
#include <sstream>

#include "intersect/scene.h"
#include "schemes/limit_surface.h"
#include "tests/models.h"

namespace shaolin {

/// The corners of a patch's domain in order.
inline std::vector<std::array<double, 2>> domain_corners(const LimitSurface& surface) {
  if (surface.triangular()) return {{0, 0}, {1, 0}, {0, 1}};
  return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

/// The point at `along` in [0, 1] of side k of a patch.
inline SurfaceParameter on_side(const LimitSurface& surface, int face, int sub, std::size_t k, double along) {
  const auto corners = domain_corners(surface);
  const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
  // Exact at the ends and on axis-parallel sides.
  double u = a[0] == b[0] ? a[0] : a[0] < b[0] ? along : 1 - along;
  double v = a[1] == b[1] ? a[1] : a[1] < b[1] ? along : 1 - along;
  if (surface.triangular() && k == 1) u = 1 - v;
  return {face, sub, u, v};
}

/// Calls visit(face, sub) for every patch that has a limit surface.
template <class Visit>
void for_each_patch(const LimitSurface& surface, Visit visit) {
  for (int face = 0; face < surface.face_count(); ++face) {
    if (!surface.has_limit(face)) continue;
    for (int sub = 0; sub < surface.sub_count(face); ++sub) visit(face, sub);
  }
}

/// A ray through `target`, from `distance` away.
inline Ray ray_at(const Vec3& target, const Vec3& direction, double distance) {
  return {target - distance * direction, direction, 0, std::numeric_limits<double>::infinity()};
}

/// The distance of a point from the ray's line.
inline double distance_to_line(const Ray& ray, const Vec3& point) {
  return (point - ray.origin).cross(ray.direction.normalized()).norm();
}

/// What is true of every hit: t within the interval, the position on the ray, a unit normal, the parameter in range.
/// Returns the first fault in words, or an empty string.
inline std::string fault_of(const Scene& scene, const Ray& ray, const Hit& hit, double diagonal) {
  const double allowed = 1e-12 * (std::abs(hit.t) * ray.direction.norm() + diagonal);
  const LimitSurface& surface = scene.surface();
  if (!(hit.t >= ray.tmin && hit.t <= ray.tmax)) return "t is outside the interval";
  if (!((hit.sample.position - (ray.origin + hit.t * ray.direction)).norm() <= allowed))
    return "the position is off the ray";
  if (!(std::abs(hit.sample.normal.norm() - 1) < 1e-12)) return "the normal is not unit";
  if (hit.at.face < 0 || hit.at.face >= surface.face_count() || !surface.has_limit(hit.at.face)) return "no such face";
  if (hit.at.sub < 0 || hit.at.sub >= surface.sub_count(hit.at.face)) return "no such sub";
  if (!(hit.at.u >= 0 && hit.at.v >= 0 && hit.at.u <= 1 && hit.at.v <= 1)) return "(u, v) is out of range";
  if (surface.triangular() && !(hit.at.u + hit.at.v <= 1)) return "u + v > 1";
  return {};
}

}  // namespace shaolin
