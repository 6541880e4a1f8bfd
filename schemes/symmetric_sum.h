#pragma once
/// Sums around a vertex or a face that do not depend, to the last bit, on where the walk around it began.
///
/// Two patches that share a vertex walk its ring from different faces. Floating-point addition commutes but does not
/// associate, so a running sum would give the two patches different points; the sums here give the same ones. That is
/// why neighbouring patches agree bit for bit on what they share, and why patch and mesh hierarchy do.
#include <algorithm>
#include <vector>

#include "vec3.h"

namespace shaolin {

/// Points picked out of an array by indices: the points around a vertex, or of a face, in cyclic order.
struct PointGather {
  const Vec3* points = nullptr;
  const int* indices = nullptr;
  int count = 0;

  const Vec3& operator[](int i) const { return points[indices[i]]; }
};

namespace detail {

/// Invariant under every permutation: smallest and largest first, then the one between them, per coordinate.
inline Vec3 sum_of_three(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 low = a.cwiseMin(b).cwiseMin(c);
  const Vec3 high = a.cwiseMax(b).cwiseMax(c);
  const Vec3 middle = a.cwiseMin(b).cwiseMax(a.cwiseMax(b).cwiseMin(c));
  return (low + high) + middle;
}

/// Invariant under every permutation: coordinates are sorted before they are added.
inline Vec3 sum_sorted(const PointGather& gather) {
  std::vector<double> values(static_cast<std::size_t>(gather.count));
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < gather.count; ++i) values[static_cast<std::size_t>(i)] = gather[i][axis];
    std::sort(values.begin(), values.end());
    double total = 0;
    for (const double value : values) total += value;
    sum[axis] = total;
  }
  return sum;
}

}  // namespace detail

/// The sum of the points, the same to the last bit for every rotation and reflection of the cyclic order.
/// O(n) for the valences that matter (opposite points pair up), else O(n log n).
inline Vec3 symmetric_sum(const PointGather& p) {
  switch (p.count) {
    case 1:
      return p[0];
    case 2:
      return p[0] + p[1];
    case 3:
      return detail::sum_of_three(p[0], p[1], p[2]);
    case 4:
      return (p[0] + p[2]) + (p[1] + p[3]);
    case 6:
      return detail::sum_of_three(p[0] + p[3], p[1] + p[4], p[2] + p[5]);
    default:
      return detail::sum_sorted(p);
  }
}

}  // namespace shaolin
