#include "ray_order.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
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

/// Where a ray enters the box, in 1024 steps along each axis, and the octant of its direction.
struct Entry {
  bool is_hit = false;
  std::uint64_t octant = 0;
  std::array<std::uint64_t, 3> step{0, 0, 0};
};

/// Only neighbourhood matters here, so rounding and a direction's zeros are nobody's harm.
Entry entry(const Ray& ray, const Box& box) {
  Entry result;
  double enter = ray.tmin, leave = ray.tmax;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = ray.direction[axis], low = (box.lower[axis] - ray.origin[axis]) / d,
                 high = (box.upper[axis] - ray.origin[axis]) / d;
    result.octant |= std::uint64_t{d < 0} << axis;
    if (d == 0) continue;
    enter = std::max(enter, std::min(low, high));
    leave = std::min(leave, std::max(low, high));
  }
  result.is_hit = enter <= leave;
  for (int axis = 0; result.is_hit && axis < 3; ++axis) {
    constexpr double steps = 1024;
    const double at = ray.origin[axis] + enter * ray.direction[axis];
    const double share = (at - box.lower[axis]) / (box.upper[axis] - box.lower[axis]);
    const double step = std::clamp(std::floor(steps * share), 0.0, steps - 1);
    if (step > 0) result.step[static_cast<std::size_t>(axis)] = static_cast<std::uint64_t>(step);  // a NaN is no step
  }
  return result;
}

std::uint64_t key(const Entry& entry) {
  if (!entry.is_hit) return last;
  const auto& [x, y, z] = entry.step;
  return entry.octant << 30 | spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

bool are_near(const Entry& a, const Entry& b) {
  if (!a.is_hit || !b.is_hit) return a.is_hit == b.is_hit;
  constexpr std::uint64_t near = 1024 / 16;
  bool result = a.octant == b.octant;
  for (std::size_t axis = 0; axis < 3; ++axis)
    result &= std::max(a.step[axis], b.step[axis]) - std::min(a.step[axis], b.step[axis]) < near;
  return result;
}

bool is_coherent(std::span<const Ray> rays, const Box& box) {
  constexpr std::size_t samples = 512;
  const std::size_t stride = rays.size() / samples + 1;
  std::size_t asked = 0, near = 0;
  for (std::size_t i = 1; i < rays.size(); i += stride, ++asked)
    near += are_near(entry(rays[i - 1], box), entry(rays[i], box));
  return 8 * near >= 7 * asked;
}

}  // namespace

std::vector<std::uint32_t> coherent_order(std::span<const Ray> rays, const Box& box) {
  std::vector<std::uint32_t> order(rays.size());
  std::iota(order.begin(), order.end(), 0U);
  if (is_coherent(rays, box)) return order;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      keys[i] = {key(entry(rays[i], box)), static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(keys);
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& pair) { return pair.second; });
  return order;
}

}  // namespace shaolin
