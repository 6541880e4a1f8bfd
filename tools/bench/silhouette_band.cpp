#include "tools/bench/silhouette_band.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shaolin {

double band_width(const ChordOptions& options, const Footprint& footprint, double distance) {
  return band_factor * std::max(options.epsilon, options.min_size * footprint.at(distance));
}

SilhouetteBand silhouette_band(const Scene& exact, const Ray& ray, double width) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr int directions = 8;
  const double length = ray.direction.norm();
  const Vec3 along = ray.direction / length;
  const Vec3 right = along.unitOrthogonal(), up = along.cross(right);
  SilhouetteBand band{.nearest = infinity, .farthest = -infinity};
  const auto ask = [&](const Ray& shifted) {
    const std::optional<Hit> hit = exact.intersect(shifted);
    band.any_miss |= !hit;
    if (!hit) return;
    band.nearest = std::min(band.nearest, hit->t * length);
    band.farthest = std::max(band.farthest, hit->t * length);
  };
  for (const double share : {1.0, 0.5, 0x1p-2, 0x1p-3, 0x1p-6, 0x1p-9, 0x1p-12, 0x1p-15, 0x1p-18, 0x1p-21, 0x1p-24})
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions;
      Ray shifted = ray;
      shifted.origin += share * width * (std::cos(angle) * right + std::sin(angle) * up);
      ask(shifted);
      for (const double more : {width / length, -width / length}) {
        Ray other = shifted;
        other.tmin -= more;
        other.tmax += more;
        if (other.tmin <= other.tmax) ask(other);  // nothing is left of an interval of two widths
      }
    }
  return band;
}

bool is_near(const Scene& exact, const Vec3& point, const Vec3& normal, double width) {
  constexpr int directions = 8;
  const Vec3 right = normal.unitOrthogonal(), up = normal.cross(right);
  const auto is_met = [&](const Vec3& at, double reach) {
    return exact.occluded({at - reach * normal, normal, 0, 2 * reach});
  };
  if (is_met(point, width)) return true;
  for (int i = 0; i < directions; ++i) {  // beside the rim of an open surface
    const double angle = 2 * std::numbers::pi * i / directions;
    if (is_met(point + 0.5 * width * (std::cos(angle) * right + std::sin(angle) * up), std::sqrt(0.75) * width))
      return true;
  }
  return false;
}

}  // namespace shaolin
