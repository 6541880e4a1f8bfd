#include "whitening.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace shaolin {

std::optional<Eigen::Matrix3d> whitening(std::span<const Vec3> points) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const Vec3& point : points) moments += point * point.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments);
  const double longest = axes.eigenvalues().z();
  if (!(longest > 0)) return {};
  const Vec3 extents =
      axes.eigenvalues().unaryExpr([&](double e) { return std::sqrt(e > 1e-26 * longest ? e : longest); });
  return axes.eigenvectors() * extents.cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();
}

}  // namespace shaolin
