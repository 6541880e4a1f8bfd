#include "box_space.h"

namespace shaolin {

BoxSpace::BoxSpace(const Box& scene) {
  const double half = (0.5 * scene.upper - 0.5 * scene.lower).maxCoeff();
  if (!std::isfinite(half) || half < 0) return;
  centre = scene.centre();
  constexpr int largest = 1000;  // a scene of one point has no size
  scale = std::scalbn(1.0, half > 0 ? std::min(-std::ilogb(half) - 1, largest) : 0);
}

EightBoxes::EightBoxes() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (auto& axis : bounds[0]) std::fill(std::begin(axis), std::end(axis), infinity);
  for (auto& axis : bounds[1]) std::fill(std::begin(axis), std::end(axis), -infinity);
}

SceneBox EightBoxes::bound() const {
  SceneBox all;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    all.bounds[0][axis] = *std::min_element(std::begin(bounds[0][axis]), std::end(bounds[0][axis]));
    all.bounds[1][axis] = *std::max_element(std::begin(bounds[1][axis]), std::end(bounds[1][axis]));
  }
  return all;
}

/// (Rounding to the nearest float moves a number by 2^-24 of it at most, or by 2^-150: what it is moved by before
/// covers that. So it takes no branches.)
SceneBox::SceneBox(const Box& box, const BoxSpace& space) {
  const Vec3 lower = space(box.lower), upper = space(box.upper);
  const auto margin = [](double bound) { return (0x1p-22 + 0x1.1p-24) * std::abs(bound) + 0x1p-149; };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = lower[static_cast<Eigen::Index>(axis)], high = upper[static_cast<Eigen::Index>(axis)];
    bounds[0][axis] = static_cast<float>(low - margin(low));
    bounds[1][axis] = static_cast<float>(high + margin(high));
  }
}

}  // namespace shaolin
