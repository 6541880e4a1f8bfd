#pragma once
/// Many boxes against one point: lower bounds of its distances from what they hold.
#include "box_space.h"

namespace shaolin {

/// A point in a scene's coordinates, with a metric: the distance of a y from the point q is |R (y - q)| for an upper
/// triangular R. (Under any linear map A = Q R, lengths are those under R; where the map is a turn with a scale, R is a
/// multiple of the identity and the bounds of boxes are tight.)
///
/// With c the middle of a box relative to q and h half its extent, row i of R (y - q) is at least |R c|_i - (|R| h)_i
/// in size. This is worked out in double precision: a point that is far away asks for the digits.
///
/// As BoxRay's, distances are kept in single precision, from a start on: that of the bounds of all boxes.
class BoxPoint {
 public:
  /// What moves computed distances by up to `error` is for the caller to say; what rounding does here is added: |R|
  /// (|q|
  /// + |y|), with |y| below 4, is good to 64 u. (Sums of magnitudes, which are no less than lengths, have no squares to
  /// leave the range of numbers.) The metric is to bring distances to about 1, for the same reason.
  BoxPoint(const Vec3& point, const Eigen::Matrix3d& metric, double error, const Box& all)
      : point_(point),
        metric_(metric),
        slack_(error + 64 * unit_roundoff * metric.lpNorm<1>() * (point.lpNorm<1>() + 4)) {
    start_ = std::sqrt(squared_distance(all.lower, all.upper));
  }

  /// A distance from the point in single precision, moved on by more than rounding may take from it.
  float local(double distance) const {
    const double value = distance - start_;
    return static_cast<float>(value + 0x1p-22 * std::abs(value) + 4 * unit_roundoff * start_);
  }

  /// A lower bound of the distance from what a box holds.
  float distance(const SceneBox& box) const {
    const auto side = [](const float(&b)[3]) { return Vec3(b[0], b[1], b[2]); };
    return rounded_down(std::sqrt(squared_distance(side(box.bounds[0]), side(box.bounds[1]))));
  }

  /// Those of eight boxes that may hold something which is not beyond `far`, as bits; lower bounds of its distances.
  unsigned meet(const EightBoxes& boxes, float far, std::array<float, 8>& entries) const {
    constexpr std::size_t count = 8;
    double middle[3][count], half[3][count], sum[count] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double origin = point_[static_cast<Eigen::Index>(axis)];
      for (std::size_t i = 0; i < count; ++i) {
        const double low = boxes.bounds[0][axis][i], high = boxes.bounds[1][axis][i];
        middle[axis][i] = 0.5 * (low + high) - origin;
        half[axis][i] = 0.5 * (high - low);
      }
    }
    for (std::size_t row = 0; row < 3; ++row) {
      double reach[count] = {}, size[count];
      std::fill(std::begin(size), std::end(size), slack_);
      for (std::size_t axis = row; axis < 3; ++axis) {
        const double factor = metric_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis));
        const double magnitude = std::abs(factor);
        for (std::size_t i = 0; i < count; ++i) {
          reach[i] += factor * middle[axis][i];
          size[i] += magnitude * half[axis][i];
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        const double least = std::abs(reach[i]) - size[i];
        sum[i] += least > 0 ? least * least : 0;
      }
    }
    const double limit = squared(far);
    unsigned met = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_empty = boxes.bounds[0][0][i] > boxes.bounds[1][0][i];
      if (is_empty || !(sum[i] <= limit)) continue;
      met |= 1U << i;
      entries[i] = rounded_down(std::sqrt(sum[i]));
    }
    return met;
  }

 private:
  double squared_distance(const Vec3& lower, const Vec3& upper) const {
    const Vec3 middle = 0.5 * (lower + upper) - point_, half = 0.5 * (upper - lower);
    double sum = 0;
    for (Eigen::Index row = 0; row < 3; ++row) {
      double reach = 0, size = slack_;
      for (Eigen::Index axis = row; axis < 3; ++axis) {
        reach += metric_(row, axis) * middle[axis];
        size += std::abs(metric_(row, axis)) * half[axis];
      }
      if (const double least = std::abs(reach) - size; least > 0) sum += least * least;
    }
    return sum;
  }

  float rounded_down(double distance) const {
    const double value = distance - start_;
    return static_cast<float>(value - 0x1p-22 * std::abs(value));
  }

  double squared(float far) const {
    const double distance = std::max(far + start_, 0.0);
    return distance * distance;
  }

  Vec3 point_;
  Eigen::Matrix3d metric_;
  double slack_, start_;
};

}  // namespace shaolin
