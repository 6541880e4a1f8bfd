#pragma once
// What a chord finish promises, against the exact finish: every ray's answer is, to the tolerance, the exact answer of
// a ray at most a band's width aside.
#include <cmath>
#include <numbers>
#include <optional>

#include "intersect/scene.h"

namespace shaolin {

enum class Agreement { same, in_band, lost, ghost };

/// Compares an answer with the exact one. `band`: twice epsilon, for chord faces leave the limit by less than epsilon
/// across the ray, on the inside or on the outside. Along the ray hits may differ by half as much again. A hit may also
/// be the answer of two rays of the band: one that lets it through, and the surface that is near it.
inline Agreement agreement(const Scene& exact, const Ray& ray, const std::optional<Hit>& answer, double band) {
  const double length = ray.direction.norm();
  const auto agrees = [&](const std::optional<Hit>& other) {
    if (!other || !answer) return !other && !answer;
    return std::abs(other->t - answer->t) * length <= 1.5 * band;
  };
  const std::optional<Hit> expected = exact.intersect(ray);
  if (agrees(expected)) return Agreement::same;
  const double until = answer ? answer->t * length - band : 0;
  const bool is_near = answer && exact.occluded({answer->sample.position - band * answer->sample.normal,
                                                 answer->sample.normal, 0, 2 * band});
  const Vec3 x = ray.direction.unitOrthogonal(), y = ray.direction.normalized().cross(x);
  for (const double share : {0x1p-24, 0x1p-18, 0x1p-12, 0x1p-6, 0.125, 0.25, 0.5, 1.0})
    for (int k = 0; k < 16; ++k) {
      Ray aside = ray;
      const double angle = k * std::numbers::pi / 8;
      aside.origin += share * band * (std::cos(angle) * x + std::sin(angle) * y);
      const std::optional<Hit> hit = exact.intersect(aside);
      if (agrees(hit) || (is_near && (!hit || hit->t * length >= until))) return Agreement::in_band;
    }
  return expected && (!answer || answer->t > expected->t) ? Agreement::lost : Agreement::ghost;
}

/// How many of some rays' answers are what.
struct Agreements {
  int same = 0, in_band = 0, lost = 0, ghosts = 0;

  void add(Agreement agreement) {
    ++(agreement == Agreement::same      ? same
       : agreement == Agreement::in_band ? in_band
       : agreement == Agreement::lost    ? lost
                                         : ghosts);
  }
};

}  // namespace shaolin
