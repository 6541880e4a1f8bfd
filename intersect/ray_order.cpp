#include "ray_order.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace shaolin {
namespace {

constexpr std::uint64_t last = std::numeric_limits<std::uint64_t>::max();

/// The ten bits of a number, two zeros after each.
std::uint64_t spread_bits(std::uint64_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

/// Only neighbourhood matters here, so rounding and a direction's zeros are nobody's harm.
std::uint64_t key(const Ray& ray, const Box& box) {
  double enter = ray.tmin, leave = ray.tmax;
  std::uint64_t octant = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis], low = (box.lower[axis] - ray.origin[axis]) / d,
                 high = (box.upper[axis] - ray.origin[axis]) / d;
    octant |= std::uint64_t{d < 0} << axis;
    if (d == 0) continue;
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  }
  if (!(enter <= leave)) return last;
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double steps = 1024;
    const double at = ray.origin[axis] + enter * ray.direction[axis];
    const double share = (at - box.lower[axis]) / (box.upper[axis] - box.lower[axis]);
    const double step = std::clamp(std::floor(steps * share), 0.0, steps - 1);
    if (step > 0) place |= spread_bits(static_cast<std::uint64_t>(step)) << axis;  // a NaN is no step
  }
  return octant << 30 | place;
}

}  // namespace

std::vector<std::uint32_t> coherent_order(std::span<const Ray> rays, const Box& box) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      keys[i] = {key(rays[i], box), static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(keys);
  std::vector<std::uint32_t> order(rays.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& pair) { return pair.second; });
  return order;
}

}  // namespace shaolin
