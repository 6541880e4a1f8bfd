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

SceneBox::SceneBox(const Box& box, const BoxSpace& space) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Vec3 lower = space(box.lower), upper = space(box.upper);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = lower[static_cast<Eigen::Index>(axis)], high = upper[static_cast<Eigen::Index>(axis)];
    low -= 0x1p-22 * std::abs(low);
    high += 0x1p-22 * std::abs(high);
    float &to_low = bounds[0][axis] = static_cast<float>(low), &to_high = bounds[1][axis] = static_cast<float>(high);
    if (to_low > low) to_low = std::nextafter(to_low, -infinity);
    if (to_high < high) to_high = std::nextafter(to_high, infinity);
  }
}

}  // namespace shaolin
