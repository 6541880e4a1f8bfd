#include "point_approach.h"

namespace shaolin {

namespace {

/// A power of two that brings lengths of this size to about 1.
double to_unit(double size) {
  constexpr int largest = 1000;
  return size > 0 && std::isfinite(size) ? std::scalbn(1.0, std::clamp(-std::ilogb(size) - 1, -largest, largest)) : 1;
}

/// The point in the boxes' coordinates; their middle where it leaves the range of numbers there.
Vec3 in_boxes(const Vec3& local, const BoxSpace& boxes) {
  const Vec3 point = boxes(local);
  return point.allFinite() ? point : Vec3(Vec3::Zero());
}

}  // namespace

/// The point goes into the object's space rounded. How far from the point its image there is comes out of the map
/// itself: by as much may distances from boxes be wrong, and by what the sum of four terms for it rounds.
PointApproach::PointApproach(const PointQuery& query, const Box& bounds, const BoxSpace& boxes, RayCounters& count)
    : space(boxes),
      counters(count),
      is_identity_(query.placement.is_identity()),
      linear_(query.placement.to_world().linear()),
      point_(query.point),
      offset_(query.placement.to_world().translation() - query.point),
      box_point_([&] {
        const Vec3 asked = in_boxes(query.placement.to_object(query.point), boxes);
        const Vec3 local = boxes.centre + asked / boxes.scale;
        const double size =
            linear_.lpNorm<1>() * ((local - bounds.centre()).lpNorm<1>() + (bounds.upper - bounds.lower).lpNorm<1>());
        scale_ = to_unit(size);
        stretch_ = scale_ * linear_.reshaped().stableNorm();  // (of a matrix, Eigen 3.4 takes rows that are not there)
        double error = 0;
        if (!is_identity_) {
          const double sum =
              linear_.cwiseAbs().rowwise().sum().maxCoeff() * std::max(local.lpNorm<1>(), bounds.largest_coordinate()) +
              offset_.lpNorm<1>();
          map_error_ = 16 * unit_roundoff * scale_ * sum;
          error = scale_ * (linear_ * local + offset_).lpNorm<1>() + map_error_;
        } else if (boxes(point_) != asked) {
          error = std::numeric_limits<double>::infinity();
        }
        const Eigen::Matrix3d metric = (scale_ / boxes.scale) * query.placement.metric();
        return BoxPoint(asked, metric, error, {boxes(bounds.lower), boxes(bounds.upper)});
      }()),
      distance_(scale_ * query.radius) {
  box_limit_ = box_point_.local(distance_ + error(1));
}

void PointApproach::relative(const Net& from, Net& to) const {
  for (std::size_t i = 0; i < 16; i += 4) {
    const Four x(&from.x[i]), y(&from.y[i]), z(&from.z[i]);
    if (is_identity_) {
      const Four scale(scale_);
      (scale * (x - Four(point_.x()))).store(&to.x[i]);
      (scale * (y - Four(point_.y()))).store(&to.y[i]);
      (scale * (z - Four(point_.z()))).store(&to.z[i]);
      continue;
    }
    const auto row = [&](Eigen::Index axis) {
      const Four sum = Four(linear_(axis, 0)) * x + Four(linear_(axis, 1)) * y + Four(linear_(axis, 2)) * z;
      return Four(scale_) * (sum + Four(offset_[axis]));
    };
    row(0).store(&to.x[i]);
    row(1).store(&to.y[i]);
    row(2).store(&to.z[i]);
  }
}

bool PointApproach::take(const Vec3& place, double error) {
  const double distance = place.norm();
  if (is_found_ ? !(distance < distance_) : !(distance <= limit(error))) return false;
  is_found_ = true;
  distance_ = distance;
  toward_ = place;
  box_limit_ = box_point_.local(distance);
  return true;
}

}  // namespace shaolin
