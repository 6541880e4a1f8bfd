#pragma once
/// Convex hulls in a plane.
#include <Eigen/Core>

namespace shaolin {

/// Tells whether the convex hull of points that come one by one holds the origin. Directions seen from the origin are
/// kept as the cone from `first_` to `last_`, narrower than half a turn; the point that no such cone can take up closes
/// the hull around the origin. O(1) a point.
class OriginInHull {
 public:
  /// Points within `error` of the hull count as in it: each stands for the square of that half side around it.
  explicit OriginInHull(double error = 0) : error_(error) {}

  void add(double x, double y) {
    if (error_ == 0) return turn({x, y});
    for (const double dx : {-error_, error_})
      for (const double dy : {-error_, error_}) turn({x + dx, y + dy});
  }

  bool holds() const { return holds_; }

 private:
  using Vec2 = Eigen::Vector2d;

  static double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

  void turn(const Vec2& p) {
    if (holds_) return;
    if (is_first_) {
      is_first_ = false;
      first_ = last_ = p;
      holds_ = p.isZero(0);
      return;
    }
    const double from_first = cross(first_, p), from_last = cross(last_, p);
    if (from_first >= 0 && from_last <= 0) {
      holds_ = from_first == 0 && from_last == 0 && first_.dot(p) <= 0;  // all on one line, on both sides
    } else if (from_first > 0) {
      last_ = p;
    } else if (from_last < 0) {
      first_ = p;
    } else {
      holds_ = true;
    }
  }

  double error_;
  bool is_first_ = true, holds_ = false;
  Vec2 first_ = Vec2::Zero(), last_ = Vec2::Zero();
};

}  // namespace shaolin
