#pragma once
/// Points and vectors of the library: three doubles, Eigen's algebra.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace shaolin {

using Vec3 = Eigen::Vector3d;

}  // namespace shaolin
