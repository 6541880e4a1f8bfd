#pragma once
/// Random numbers that are the same with every compiler and standard library: the distributions of <random> are not.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "schemes/vec3.h"

namespace shaolin {

class SampleRandom {
 public:
  explicit SampleRandom(std::uint64_t seed) : engine_(seed) {}

  /// In [0, 1), in steps of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// With a uniform logarithm; both bounds are positive.
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  /// In [0, count); its bias is below count * 2^-53.
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }
  bool one_in(std::size_t count) { return index(count) == 0; }

  Vec3 inside(const Vec3& lower, const Vec3& upper) {
    const double x = unit(), y = unit(), z = unit();
    return lower + Vec3(x, y, z).cwiseProduct(upper - lower);
  }
  /// A unit vector, uniform on the sphere (Archimedes: its z is uniform).
  Vec3 direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi);
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace shaolin
