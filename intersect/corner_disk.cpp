#include "corner_disk.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "../schemes/limit_surface.h"

namespace shaolin {

namespace {

/// The nearest corner of a face.
Parameter corner_of(const SurfaceParameter& at, bool triangular) {
  if (!triangular) return {std::round(at.u), std::round(at.v)};
  const double w = 1 - at.u - at.v;
  if (w >= at.u && w >= at.v) return {0, 0};
  return at.u >= at.v ? Parameter(1, 0) : Parameter(0, 1);
}

double distance_from(const Parameter& corner, const SurfaceParameter& at) {
  return std::max(std::abs(at.u - corner.x()), std::abs(at.v - corner.y()));
}

/// From one point to another, without what lies along the ray.
Vec3 seen(const Vec3& from, const Vec3& to, const Vec3& direction) {
  const Vec3 way = to - from;
  return way - way.dot(direction) * direction;
}

}  // namespace

SurfaceParameter nearest_corner(const SurfaceParameter& at, bool triangular) {
  const Parameter corner = corner_of(at, triangular);
  return {at.face, at.sub, corner.x(), corner.y()};
}

bool is_at_corner(const SurfaceParameter& at) {
  const auto is_end = [](double x) { return x < 1e-6 || x > 1 - 1e-6; };
  return is_end(at.u) && is_end(at.v);
}

std::pair<Parameter, Parameter> sides_at(const Parameter& corner, double far, bool triangular) {
  const double u = corner.x(), v = corner.y();
  if (u == 0 && v == 0) return {{far, 0}, {0, far}};
  if (triangular) {
    if (u == 1) return {{1 - far, far}, {1 - far, 0}};
    return {{0, 1 - far}, {far, 1 - far}};
  }
  if (v == 0) return {{1, far}, {1 - far, 0}};
  if (u == 1) return {{1 - far, 1}, {1, 1 - far}};
  return {{0, 1 - far}, {far, 1}};
}

double corner_angle(const SurfaceParameter& at, const LimitSurface& surface, const Vec3& direction) {
  constexpr double chord = 1e-3;
  const Parameter corner(std::round(at.u), std::round(at.v));
  const auto [next, last] = sides_at(corner, chord, surface.triangular());
  const auto point = [&](const Parameter& p) { return surface.evaluate({at.face, at.sub, p.x(), p.y()}); };
  const auto middle = point(corner), to_next = point(next), to_last = point(last);
  if (!middle || !to_next || !to_last) return std::numbers::pi;
  const Vec3 a = seen(middle->position, to_next->position, direction);
  const Vec3 b = seen(middle->position, to_last->position, direction);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::optional<CornerDisk> CornerDisk::around(std::span<const SurfaceParameter> places, bool triangular) {
  CornerDisk disk;
  disk.triangular_ = triangular;
  for (std::size_t i = 0; i < places.size();) {
    const SurfaceParameter& first = places[i];
    std::size_t end = i;
    while (end < places.size() && places[end].face == first.face && places[end].sub == first.sub) ++end;
    const auto of_face = places.subspan(i, end - i);
    const auto from_nearest = [&](const SurfaceParameter& at) { return distance_from(corner_of(at, triangular), at); };
    const SurfaceParameter& nearest = *std::min_element(
        of_face.begin(), of_face.end(),
        [&](const SurfaceParameter& a, const SurfaceParameter& b) { return from_nearest(a) < from_nearest(b); });
    const SurfaceParameter& corner = disk.corners_.emplace_back(nearest_corner(nearest, triangular));
    for (const SurfaceParameter& at : of_face)
      disk.radius_ = std::max(disk.radius_, 2 * distance_from({corner.u, corner.v}, at));
    i = end;
  }
  constexpr double largest = 0.5;
  if (!(disk.radius_ <= largest)) return {};
  return disk;
}

bool CornerDisk::contains(const SurfaceParameter& at) const {
  return std::any_of(corners_.begin(), corners_.end(), [&](const SurfaceParameter& corner) {
    return corner.face == at.face && corner.sub == at.sub && distance_from({corner.u, corner.v}, at) <= radius_;
  });
}

namespace {

/// A curve of the surface as a ray sees it, and a bound of how near it may come.
struct SeenCurve {
  std::function<std::optional<Vec3>(double)> at;  ///< from the ray, in [0, 1]; empty if it is nearer than the bound
  Vec3 direction;

  /// By how much the part between two places turns around the ray: halved until each part turns by a right angle at
  /// most. (A face may look like a sliver, whose rim passes close by the ray between places that are far from it.)
  std::optional<double> turn(double from, const Vec3& first, double to, const Vec3& last) const {
    const double angle = std::atan2(direction.dot(first.cross(last)), first.dot(last));
    if (std::abs(angle) <= 0.5 * std::numbers::pi) return angle;
    constexpr double shortest = 0x1p-30;
    const double half = 0.5 * (from + to);
    const std::optional<Vec3> middle = to - from > shortest ? at(half) : std::nullopt;
    if (!middle) return {};
    const auto before = turn(from, first, half, *middle), after = turn(half, *middle, to, last);
    if (!before || !after) return {};
    return *before + *after;
  }
};

}  // namespace

std::optional<double> CornerDisk::wind(const LimitSurface& surface, const Vec3& through, const Vec3& direction,
                                       double clearance) const {
  constexpr int steps = 4;
  double sum = 0;
  for (const SurfaceParameter& corner : corners_) {
    const auto [next, last] = sides_at({corner.u, corner.v}, radius_, triangular_);
    const SeenCurve rim{[&, next = next, last = last](double share) -> std::optional<Vec3> {
                          const Parameter p = (1 - share) * next + share * last;
                          const auto sample = surface.evaluate({corner.face, corner.sub, p.x(), p.y()});
                          if (!sample) return {};
                          const Vec3 here = seen(through, sample->position, direction);
                          return here.norm() > clearance ? std::optional(here) : std::nullopt;
                        },
                        direction};
    std::optional<Vec3> before = rim.at(0);
    for (int i = 1; i <= steps; ++i) {
      constexpr double step = 1.0 / steps;
      const std::optional<Vec3> here = rim.at(i * step);
      if (!before || !here) return {};
      const std::optional<double> angle = rim.turn((i - 1) * step, *before, i * step, *here);
      if (!angle) return {};
      sum += *angle;
      before = here;
    }
  }
  return sum / (2 * std::numbers::pi);
}

std::optional<int> CornerDisk::grow_and_wind(const LimitSurface& surface, const Vec3& through, const Vec3& direction,
                                             double clearance) {
  // Beside 1 parameters have 53 digits: 13 of them are left for the smallest rim.
  constexpr double smallest = 0x1p-40, largest = 0.5, step = 8;
  for (radius_ = std::max(radius_, smallest); radius_ <= largest; radius_ *= step)
    if (const std::optional<double> turns = wind(surface, through, direction, clearance)) {
      // The rim of a disk that misses a face, or lies at a boundary, has a gap. (Sums of angles are good to 1e-15, and
      // ends of neighbours' arcs are one point.)
      constexpr double closed = 0.01;
      const double whole = std::round(*turns);
      if (std::abs(*turns - whole) > closed) return {};
      return static_cast<int>(whole);
    }
  return {};
}

}  // namespace shaolin
