#pragma once
// Random numbers that are the same on every machine and in every run.
#include <cmath>
#include <cstdint>
#include <random>

#include "schemes/vec3.h"

namespace shaolin {

/// The standard fixes the engine's sequence but not that of its distributions: these are our own. Nor does it fix the
/// order of a call's arguments or of the factors of a product: draw twice in braces or in two statements.
class Random {
 public:
  explicit Random(std::uint64_t seed = 1) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// In [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, count).
  int index(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  /// In the cube [-1, 1]^3.
  Vec3 point() {
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    return {x, y, uniform(-1, 1)};
  }
  /// A unit vector, uniform on the sphere.
  Vec3 direction() {
    for (;;) {
      const Vec3 p = point();
      if (const double length = p.norm(); length > 0.1 && length <= 1) return p / length;
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace shaolin
