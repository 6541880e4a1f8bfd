#pragma once
/// The linear map that makes a cloud of points as long as it is wide.
#include <Eigen/Core>
#include <optional>
#include <span>

#include "vec3.h"

namespace shaolin {

/// The symmetric map after which the points' second moments about the origin are equal along all axes that they extend
/// to; an axis shorter than rounding makes the others is none and is left alone. Empty if all points are the origin.
std::optional<Eigen::Matrix3d> whitening(std::span<const Vec3> points);

}  // namespace shaolin
