#pragma once
/// The control points of a regular patch, coordinate by coordinate, for vector instructions.
#include <algorithm>
#include <array>
#include <bit>

#include "../schemes/limit_sample.h"
#include "box.h"
#include "four.h"

namespace shaolin {

/// Sixteen places a coordinate: the points of a Bezier patch, the last one repeated where it has fewer, so that bounds
/// are those of the points.
struct Net {
  std::array<double, 16> x, y, z;

  Net() = default;
  template <class Bezier>
  explicit Net(const Bezier& patch) {
    for (std::size_t i = 0; i < 16; ++i) {
      const Vec3& p = patch.b[i < patch.b.size() ? i : patch.b.size() - 1];
      x[i] = p.x();
      y[i] = p.y();
      z[i] = p.z();
    }
  }

  template <class Bezier>
  Bezier bezier() const {
    Bezier patch;
    for (std::size_t i = 0; i < patch.b.size(); ++i) patch.b[i] = Vec3(x[i], y[i], z[i]);
    return patch;
  }
};

/// The coordinates one behind the other.
inline std::array<double, 48> by_coordinate(const Net& net) {
  std::array<double, 48> all;
  std::copy(net.x.begin(), net.x.end(), all.begin());
  std::copy(net.y.begin(), net.y.end(), all.begin() + 16);
  std::copy(net.z.begin(), net.z.end(), all.begin() + 32);
  return all;
}

/// The least and the largest of sixteen values.
struct Range {
  double low, high;

  explicit Range(const std::array<double, 16>& v) {
    const Four a(&v[0]), b(&v[4]), c(&v[8]), d(&v[12]);
    std::array<double, 4> lows, highs;
    smaller(smaller(a, b), smaller(c, d)).store(lows.data());
    larger(larger(a, b), larger(c, d)).store(highs.data());
    low = std::min(std::min(lows[0], lows[1]), std::min(lows[2], lows[3]));
    high = std::max(std::max(highs[0], highs[1]), std::max(highs[2], highs[3]));
  }
};

/// The place of the least of sixteen values, the first of equal ones.
inline std::size_t place_of_least(const std::array<double, 16>& v) {
  const Four low(Range(v).low);
  int places = 0;
  for (int i = 0; i < 16; i += 4) places |= at_most(Four(&v[static_cast<std::size_t>(i)]), low) << i;
  return places == 0 ? 0 : static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(places)));
}

/// The bounds of a net's points.
inline Box hull_of(const Net& net) {
  const Range x(net.x), y(net.y), z(net.z);
  return {Vec3(x.low, y.low, z.low), Vec3(x.high, y.high, z.high)};
}

/// Products of sixteen values and weights, summed to four.
inline Four partial_dot(const std::array<double, 16>& v, const std::array<double, 16>& w) {
  return (Four(&v[0]) * Four(&w[0]) + Four(&v[4]) * Four(&w[4])) +
         (Four(&v[8]) * Four(&w[8]) + Four(&v[12]) * Four(&w[12]));
}

/// The sum of products of sixteen values and weights.
inline double dot(const std::array<double, 16>& v, const std::array<double, 16>& w) {
  std::array<double, 4> part;
  partial_dot(v, w).store(part.data());
  return (part[0] + part[1]) + (part[2] + part[3]);
}

/// a v + b w, place by place.
inline void combine(double a, const std::array<double, 16>& v, double b, const std::array<double, 16>& w,
                    std::array<double, 16>& out) {
  for (std::size_t i = 0; i < 16; i += 4) (Four(a) * Four(&v[i]) + Four(b) * Four(&w[i])).store(&out[i]);
}

}  // namespace shaolin
