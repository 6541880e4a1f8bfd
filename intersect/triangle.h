#pragma once
/// Ray and triangle without cracks between neighbours.
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "box.h"

namespace shaolin {

/// A ray's coordinates for many triangles: Woop, Benthin and Wald, "Watertight ray/triangle intersection", JCGT 2(1),
/// 2013. Space is sheared so that the ray becomes the z axis; a point is on one side of an edge or the other by the
/// sign of one difference of two products, which two triangles that share the edge round alike. So a ray through a side
/// meets one of the two triangles there at least. At a corner this rests on the signs of all sides around it: where the
/// ray is within rounding of the corner and of a side's line, a wrong one may let it through.
class TriangleRay {
 public:
  explicit TriangleRay(const TraversalRay& ray) : origin_(ray.origin) {
    ray.direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    if (ray.direction[z_] < 0) std::swap(x_, y_);
    shear_ = Vec3(ray.direction[x_], ray.direction[y_], 1) / ray.direction[z_];
  }

  struct Meeting {
    double distance;                ///< along the unit direction
    std::array<double, 3> weights;  ///< of the corners; they sum to 1
  };

  /// Where the ray meets the triangle, on either side, with distance in [near, far]. A triangle that the ray lies in,
  /// or one without area, is missed: its neighbours are met.
  std::optional<Meeting> meet(const Vec3& a, const Vec3& b, const Vec3& c, double near, double far) const {
    const Vec3 p = sheared(a), q = sheared(b), r = sheared(c);
    const double u = r.x() * q.y() - r.y() * q.x();
    const double v = p.x() * r.y() - p.y() * r.x();
    const double w = q.x() * p.y() - q.y() * p.x();
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return {};
    const double sum = u + v + w;
    if (sum == 0) return {};
    const std::array<double, 3> weights{u / sum, v / sum, w / sum};
    const double distance = weights[0] * p.z() + weights[1] * q.z() + weights[2] * r.z();
    if (!(distance >= near && distance <= far)) return {};
    return Meeting{distance, weights};
  }

 private:
  Vec3 sheared(const Vec3& point) const {
    const Vec3 p = point - origin_;
    return {p[x_] - shear_.x() * p[z_], p[y_] - shear_.y() * p[z_], shear_.z() * p[z_]};
  }

  Vec3 origin_, shear_;
  Eigen::Index x_ = 0, y_ = 0, z_ = 0;
};

}  // namespace shaolin
