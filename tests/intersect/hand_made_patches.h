#pragma once
// Patches of points that a test chooses.
#include <functional>

#include "schemes/bezier_quad.h"

namespace shaolin {

/// Of patches by hand, whose coordinates are below 8: some 64 u of that.
inline constexpr double patch_error = 1e-13;

/// A patch of points place(u, v), which is exact for a place that is linear in u and in v.
inline BezierQuad quad(const std::function<Vec3(double, double)>& place) {
  BezierQuad patch;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      patch.b[4 * j + i] = place(static_cast<double>(i) / 3, static_cast<double>(j) / 3);
  return patch;
}

}  // namespace shaolin
