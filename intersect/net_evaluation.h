#pragma once
/// A polynomial's value and first derivatives, coordinate by coordinate, from its net.
#include "../schemes/bezier_quad.h"
#include "net.h"

namespace shaolin {

/// At one parameter, for as many coordinates as are asked for: (value, du, dv, 0).
template <class Bezier>
class NetEvaluation {
 public:
  explicit NetEvaluation(const Parameter& at) : weights_(Bezier::weights(at)) {}

  Four operator()(const std::array<double, 16>& points) const {
    return sums(partial_dot(points, weights_.value), partial_dot(points, weights_.du), partial_dot(points, weights_.dv),
                Four(0.0));
  }

 private:
  typename Bezier::Weights weights_;
};

/// Along v first: rows of the net are registers.
template <>
class NetEvaluation<BezierQuad> {
 public:
  explicit NetEvaluation(const Parameter& at) : u_(at.x()), v_(at.y()) {}

  Four operator()(const std::array<double, 16>& points) const {
    const Four row0(&points[0]), row1(&points[4]), row2(&points[8]), row3(&points[12]);
    const auto along_v = [&](const std::array<double, 4>& w) {
      return (Four(w[0]) * row0 + Four(w[1]) * row1) + (Four(w[2]) * row2 + Four(w[3]) * row3);
    };
    const Four u(u_.value.data()), du(u_.first.data()), value = along_v(v_.value);
    return sums(u * value, du * value, u * along_v(v_.first), Four(0.0));
  }

 private:
  BezierQuad::Bernstein u_, v_;
};

}  // namespace shaolin
