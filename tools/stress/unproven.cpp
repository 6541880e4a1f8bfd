#include "tools/stress/unproven.h"

#include <algorithm>
#include <cmath>

#include "intersect/corner_disk.h"

namespace shaolin::stress {

namespace {

/// The place, moved to the sides and corners that it is close to.
SurfaceParameter at_side(SurfaceParameter at, bool triangular) {
  constexpr double close = 1e-6;
  for (double SurfaceParameter::*const parameter : {&SurfaceParameter::u, &SurfaceParameter::v}) {
    if (at.*parameter < close) at.*parameter = 0;
    if (at.*parameter > 1 - close) at.*parameter = 1;
  }
  if (triangular && at.u + at.v > 1 - close) at.v = 1 - at.u;
  return at;
}

/// The place and places inside of its face, close by and not so close; at a corner all over the angle.
std::vector<SurfaceParameter> about(const SurfaceParameter& at, bool triangular) {
  std::vector<SurfaceParameter> result{at};
  const Parameter here(at.u, at.v), middle = triangular ? Parameter(1.0 / 3, 1.0 / 3) : Parameter(0.5, 0.5);
  for (const double far : {0x1p-30, 0x1p-20}) {
    std::vector<Parameter> ends{(1 - far) * here + far * middle};
    if (is_at_corner(at)) {
      const auto [next, last] = sides_at({std::round(at.u), std::round(at.v)}, far, triangular);
      for (const double share : {0.0, 0.5, 1.0}) ends.emplace_back(share * next + (1 - share) * last);
    }
    for (const Parameter& end : ends) result.push_back({at.face, at.sub, end.x(), end.y()});
  }
  return result;
}

}  // namespace

Unproven reason_of(const Subject& subject, const Ray& ray, const Hit& hit) {
  const bool triangular = subject.surface().triangular();
  const PointPlaces places = subject.surface().places_of(at_side(hit.at, triangular));
  if (!places.is_closed) return Unproven::boundary;
  const Vec3 direction = ray.direction.stableNormalized();
  double least = 1, most = -1;
  for (const SurfaceParameter& place : places.all)
    for (const SurfaceParameter& at : about(place, triangular)) {
      const double cosine = subject.evaluate(at).normal.dot(direction);
      least = std::min(least, cosine);
      most = std::max(most, cosine);
    }
  return std::max(least, -most) < subject.grazing(ray) ? Unproven::flat : Unproven::other;
}

}  // namespace shaolin::stress
