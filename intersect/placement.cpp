#include "placement.h"

#include <Eigen/QR>

#include <numbers>

namespace shaolin {

Placement::Placement(const Affine& to_world)
    : to_world_(to_world),
      to_object_(inverse(to_world).linear()),
      normals_(to_object_.transpose()),
      identity_(to_world.matrix() == Affine::Identity().matrix()) {
  // A power of two, so that squares of lengths stay within range.
  normals_ *= std::scalbn(1.0, -std::ilogb(normals_.cwiseAbs().maxCoeff()));
  if (!identity_) {
    const double size = std::scalbn(1.0, std::ilogb(to_world.linear().cwiseAbs().maxCoeff()));
    const Eigen::HouseholderQR<Eigen::Matrix3d> factors(to_world.linear() / size);
    metric_ = factors.matrixQR().triangularView<Eigen::Upper>();
    metric_ *= size;
  }
}

std::optional<Ray> Placement::to_object(const Ray& ray) const {
  if (identity_) return ray;
  Ray local{to_object_ * (ray.origin - to_world_.translation()), to_object_ * ray.direction, ray.tmin, ray.tmax,
            ray.footprint};
  if (!local.origin.allFinite() || !local.direction.allFinite() || local.direction.isZero(0)) return {};
  // Lengths shrink as they do along the ray: a map that is uneven across it is not told apart.
  const double scale = local.direction.stableNorm() / ray.direction.stableNorm();
  local.footprint.width *= scale;
  local.footprint.unit *= scale;
  return local;
}

void Placement::to_world(Hit& hit, const TraversalRay& ray) const {
  if (identity_) return;
  // Three products and three sums a coordinate, the translation among them: at most four roundings of each.
  const double norm = metric_.norm();
  const double rounding =
      4 * unit_roundoff * (norm * hit.sample.position.norm() + to_world_.translation().norm()) * std::numbers::sqrt3;
  to_world(hit.sample);
  hit.certificate.error = norm * hit.certificate.error + rounding;
  hit.certificate.residual = distance_from_line(hit.sample.position, ray.origin, ray.direction);
}

void Placement::to_world(LimitSample& sample) const {
  if (identity_) return;
  sample.position = to_world_ * sample.position;
  sample.normal = (normals_ * sample.normal).normalized();
  if (!sample.derivatives) return;
  for (Vec3 Derivatives::*derivative :
       {&Derivatives::du, &Derivatives::dv, &Derivatives::duu, &Derivatives::duv, &Derivatives::dvv})
    (*sample.derivatives).*derivative = to_world_.linear() * ((*sample.derivatives).*derivative);
}

}  // namespace shaolin
