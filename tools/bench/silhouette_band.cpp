#include "tools/bench/silhouette_band.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace shaolin {
namespace {

/// The band's shifts across a ray, the widest first.
std::vector<Vec3> shifts(const Vec3& along, double width) {
  constexpr int directions = 8;
  const Vec3 right = along.unitOrthogonal(), up = along.cross(right);
  std::vector<Vec3> all;
  for (const double share : {1.0, 0.5, 0x1p-2, 0x1p-3, 0x1p-6, 0x1p-9, 0x1p-12, 0x1p-15, 0x1p-18, 0x1p-21, 0x1p-24})
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * i / directions;
      all.push_back(share * width * (std::cos(angle) * right + std::sin(angle) * up));
    }
  return all;
}

/// Places on a ray between its hits, up to some number of them.
std::vector<double> between_hits(const Scene& exact, Ray ray, double step) {
  constexpr std::size_t most = 32;
  std::vector<double> places;
  std::optional<double> before;
  while (places.size() < most && ray.tmin <= ray.tmax) {
    const std::optional<Hit> hit = exact.intersect(ray);
    if (!hit) break;
    if (before) places.push_back(0.5 * (*before + hit->t));
    before = hit->t;
    ray.tmin = std::max(hit->t + step, std::nextafter(hit->t, std::numeric_limits<double>::infinity()));
  }
  return places;
}

}  // namespace

double band_width(const ChordOptions& options, const Footprint& footprint, double distance) {
  return band_factor * std::max(options.epsilon, options.min_size * footprint.at(distance));
}

SilhouetteBand silhouette_band(const Scene& exact, const Ray& ray, double width) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double length = ray.direction.norm();
  SilhouetteBand band{.nearest = infinity, .farthest = -infinity};
  const auto ask = [&](const Ray& shifted) {
    const std::optional<Hit> hit = exact.intersect(shifted);
    band.any_miss |= !hit;
    if (!hit) return;
    band.nearest = std::min(band.nearest, hit->t * length);
    band.farthest = std::max(band.farthest, hit->t * length);
  };
  for (const Vec3& shift : shifts(ray.direction / length, width)) {
    Ray shifted = ray;
    shifted.origin += shift;
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

bool leads_past(const Scene& exact, Ray ray, double width, const std::optional<double>& distance) {
  const double length = ray.direction.norm();
  ray.tmin += width / length;
  ray.tmax = (distance ? std::min(ray.tmax, *distance / length) : ray.tmax) - width / length;
  if (ray.tmin > ray.tmax) return true;  // all hits are within a width of an end, and chords may lie past it
  const std::vector<double> places = between_hits(exact, ray, 0x1p-24 * width / length);
  const std::vector<Vec3> all_shifts = shifts(ray.direction / length, width);
  const std::size_t end = places.size() + 1;  // 0 and end: the ray's; there the way may be on any shift
  const auto place = [&](std::size_t i) { return i == 0 ? ray.tmin : i == end ? ray.tmax : places[i - 1]; };
  const auto joins = [&](std::size_t i, const Vec3& shift) {
    return i == 0 || i == end || !exact.occluded({ray.origin + place(i) * ray.direction, shift, 0, 1});
  };
  std::vector<bool> reached(end + 1);
  reached[0] = true;
  for (std::size_t to = 1; to <= end; ++to)
    for (std::size_t from = 0; from < to && !reached[to]; ++from)
      reached[to] = reached[from] && std::any_of(all_shifts.begin(), all_shifts.end(), [&](const Vec3& shift) {
                      return !exact.occluded({ray.origin + shift, ray.direction, place(from), place(to)}) &&
                             joins(from, shift) && joins(to, shift);
                    });
  return reached[end];
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
