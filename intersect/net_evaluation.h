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

namespace detail {

/// The cubic Bernstein polynomials and their derivatives at a parameter, made in registers: what is stored a number at
/// a time and loaded four at a time waits for the stores.
struct Cubics {
  double t, s = 1 - t;

  Four value() const { return Four(s, s, s, t) * Four(s, s, t, t) * Four(s, 3 * t, 3 * t, t); }
  Four first() const { return Four(-3 * s, 3 * s, 3 * t, 3 * t) * Four(s, s - 2 * t, 2 * s - t, t); }
  Four second() const { return Four(6 * s, 6 * (t - 2 * s), 6 * (s - 2 * t), 6 * t); }
};

/// One weight for each row.
struct AlongColumns {
  Four row0, row1, row2, row3;

  explicit AlongColumns(const std::array<double, 16>& points)
      : row0(&points[0]), row1(&points[4]), row2(&points[8]), row3(&points[12]) {}
  Four operator()(const std::array<double, 4>& w) const {
    return (Four(w[0]) * row0 + Four(w[1]) * row1) + (Four(w[2]) * row2 + Four(w[3]) * row3);
  }
};

}  // namespace detail

/// Along v first: rows of the net are registers.
template <>
class NetEvaluation<BezierQuad> {
 public:
  explicit NetEvaluation(const Parameter& at)
      : value_(detail::Cubics{at.x()}.value()), first_(detail::Cubics{at.x()}.first()), v_(at.y()) {}

  Four operator()(const std::array<double, 16>& points) const {
    const detail::AlongColumns along_v(points);
    const Four value = along_v(v_.value);
    return sums(value_ * value, first_ * value, value_ * along_v(v_.first), Four(0.0));
  }

 private:
  Four value_, first_;  ///< of the cubics along u
  BezierQuad::Bernstein v_;
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
  const detail::Cubics u{at.x()};
  const Four value = u.value(), first = u.first(), second = u.second();
  const BezierQuad::Bernstein v(at.y());
  Jet jet;
  Derivatives& d = jet.derivatives;
  Eigen::Index axis = 0;
  for (const auto* points : {&net.x, &net.y, &net.z}) {
    const detail::AlongColumns along_v(*points);
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
