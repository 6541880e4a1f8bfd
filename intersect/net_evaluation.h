#pragma once
/// A polynomial's value and derivatives, coordinate by coordinate, from its net.
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

/// A polynomial's position and its derivatives up to the second.
struct Jet {
  Vec3 position;
  Derivatives derivatives;
};

template <class Bezier>
Jet jet(const Net& net, const Parameter& at) {
  const Bezier patch = net.bezier<Bezier>();
  return {patch.position(at), patch.derivatives(at)};
}

template <>
inline Jet jet<BezierQuad>(const Net& net, const Parameter& at) {
  const BezierQuad::Bernstein u(at.x()), v(at.y());
  const Four value(u.value.data()), first(u.first.data()), second(u.second.data());
  Jet jet;
  Derivatives& d = jet.derivatives;
  Eigen::Index axis = 0;
  for (const auto* points : {&net.x, &net.y, &net.z}) {
    const Four row0(&(*points)[0]), row1(&(*points)[4]), row2(&(*points)[8]), row3(&(*points)[12]);
    const auto along_v = [&](const std::array<double, 4>& w) {
      return (Four(w[0]) * row0 + Four(w[1]) * row1) + (Four(w[2]) * row2 + Four(w[3]) * row3);
    };
    const Four of_value = along_v(v.value), of_first = along_v(v.first), of_second = along_v(v.second);
    std::array<double, 4> low, high;
    sums(value * of_value, first * of_value, value * of_first, first * of_first).store(low.data());
    sums(second * of_value, value * of_second, Four(0.0), Four(0.0)).store(high.data());
    jet.position[axis] = low[0];
    d.du[axis] = low[1];
    d.dv[axis] = low[2];
    d.duv[axis] = low[3];
    d.duu[axis] = high[0];
    d.dvv[axis] = high[1];
    ++axis;
  }
  return jet;
}

}  // namespace shaolin
