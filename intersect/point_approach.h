#pragma once
/// A point on its way through an object, as a search for the closest place sees it.
#include "box_point.h"
#include "closest_point.h"
#include "counters.h"
#include "net.h"
#include "placement.h"

namespace shaolin {

/// Carries points into the frame of a query, in which the asked point is the origin and lengths are the world's, times
/// a power of two that brings the object and its distance to about 1: no square overflows or underflows. Knows how near
/// the best place found so far is, and where the work is counted.
class PointApproach {
 public:
  /// `bounds` holds the object, in its own space; its boxes are those of `boxes`.
  PointApproach(const PointQuery& query, const Box& bounds, const BoxSpace& boxes, RayCounters& count);

  const BoxSpace& space;
  RayCounters& counters;

  const BoxPoint& box_point() const { return box_point_; }

  Vec3 relative(const Vec3& point) const {
    if (is_identity_) return scale_ * (point - point_);
    return scale_ * (linear_ * point + offset_);
  }
  void relative(const Net& from, Net& to) const;

  /// The uncertainty of a distance to points whose coordinates in this frame are at most `size`: of two that differ by
  /// less none is the nearer. With u = 2^-53, a point of a polynomial is a mean of up to 16 points with weights good to
  /// 3 u, in 6 sums: 10 u a coordinate, 18 u the length. Lower bounds carry less. To this comes what the map into the
  /// frame rounds.
  double error(double size) const { return 32 * unit_roundoff * size + map_error_; }

  /// A bound of how long a vector of the object's space is here whose coordinates are at most `size`.
  double length(double size) const { return stretch_ * size; }

  /// What is farther than this is of no interest, of distances known to within an error. (Nothing that the radius may
  /// hold is dropped; against a place that was found, the error makes a difference that is none.)
  double limit(double error) const { return is_found_ ? distance_ - error : distance_ + error; }
  /// The same for boxes.
  float box_limit() const { return box_limit_; }

  /// The direction of the nearest place so far, not unit; zero if there is none.
  const Vec3& toward() const { return toward_; }

  /// Takes a place, relative to the point, if it is nearer.
  bool take(const Vec3& place, double error);

 private:
  bool is_identity_;
  Eigen::Matrix3d linear_;
  Vec3 point_, offset_;
  double scale_ = 1, stretch_ = 0, map_error_ = 0;
  BoxPoint box_point_;
  double distance_;
  float box_limit_ = 0;
  bool is_found_ = false;
  Vec3 toward_ = Vec3::Zero();
};

}  // namespace shaolin
