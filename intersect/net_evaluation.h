#pragma once
/// A polynomial's value and derivatives, coordinate by coordinate, from its net.
#include "../schemes/bezier_quad.h"
#include "../schemes/bezier_triangle.h"
#include "net.h"
#include "spline_window.h"

namespace shaolin {

/// At one parameter, for as many coordinates as are asked for: (value, du, dv, 0).
template <class Bezier>
class NetEvaluation;

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
    const detail::AlongColumns along_v{Four(&points[0]), Four(&points[4]), Four(&points[8]), Four(&points[12])};
    const Four value = along_v(v_.value);
    return sums(value_ * value, first_ * value, value_ * along_v(v_.first), Four(0.0));
  }

 private:
  Four value_, first_;  ///< of the cubics along u
  BezierQuad::Bernstein v_;
};

/// By the cubics on the triangle: with their sums A, B and C over the points, over the next ones along u and over those
/// along v, which are its points after three steps of de Casteljau's, the value is w A + u B + v C. Rows of the net
/// have 5, 4, 3, 2 and 1 points, and its last place repeats the last point.
template <>
class NetEvaluation<BezierTriangle> {
 public:
  explicit NetEvaluation(const Parameter& at) : u_(at.x()), v_(at.y()), w_(1 - u_ - v_) {}

  Four operator()(const std::array<double, 16>& points) const {
    const auto along = [&](std::size_t row0, std::size_t row1, std::size_t row2) {
      return row0_ * Four(&points[row0]) + row1_ * Four(&points[row1]) + row2_ * Four(&points[row2]);
    };
    std::array<double, 4> abc;
    (sums(along(0, 5, 9), along(1, 6, 10), along(5, 9, 12), Four(0.0)) + Four(v_ * v_ * v_) * Four(&points[12]))
        .store(abc.data());
    const auto [a, b, c, unused] = abc;
    constexpr double degree = BezierTriangle::degree;
    return {w_ * a + u_ * b + v_ * c, degree * (b - a), degree * (c - a), 0};
  }

 private:
  double u_, v_, w_;
  Four row0_{w_ * w_ * w_, 3 * w_* w_* u_, 3 * w_* u_* u_, u_* u_* u_};
  Four row1_{3 * w_ * w_ * v_, 6 * w_* u_* v_, 3 * u_* u_* v_, 0};
  Four row2_{3 * w_ * v_ * v_, 3 * u_* v_* v_, 0, 0};
};

/// A polynomial's position and its derivatives up to the second.
struct Jet {
  Vec3 position;
  Derivatives derivatives;
};

/// What the cubics weigh is put back to the window's places, which need not become Bezier points.
inline Jet jet(const SplineWindow<BezierQuad>& patch, const Parameter& at) {
  const auto& map = patch.to_bezier();
  const detail::Cubics u{at.x()}, v{at.y()};
  const Four value = map.u_weights(u.value()), first = map.u_weights(u.first()), second = map.u_weights(u.second());
  std::array<double, 4> v_value, v_first, v_second;
  map.v_weights(v.value()).store(v_value.data());
  map.v_weights(v.first()).store(v_first.data());
  map.v_weights(v.second()).store(v_second.data());
  Jet jet;
  Derivatives& d = jet.derivatives;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<std::size_t>(axis);
    const detail::AlongColumns along_v{patch.row(coordinate, 0), patch.row(coordinate, 1), patch.row(coordinate, 2),
                                       patch.row(coordinate, 3)};
    const Four of_value = along_v(v_value), of_first = along_v(v_first), of_second = along_v(v_second);
    std::array<double, 4> low, high;
    sums(value * of_value, first * of_value, value * of_first, first * of_first).store(low.data());
    sums(second * of_value, value * of_second, Four(0.0), Four(0.0)).store(high.data());
    jet.position[axis] = low[0];
    d.du[axis] = low[1];
    d.dv[axis] = low[2];
    d.duv[axis] = low[3];
    d.duu[axis] = high[0];
    d.dvv[axis] = high[1];
  }
  return jet;
}

/// Two steps of de Casteljau's leave a net of degree 2: of the quadratics on the triangle six sums over the points.
/// Their differences are the second derivatives, and another two steps give the rest.
inline Jet jet(const SplineWindow<BezierTriangle>& patch, const Parameter& at) {
  const Net net = patch.net();
  const double u = at.x(), v = at.y(), w = 1 - u - v;
  const Four row0(w * w, 2 * w * u, u * u, 0), row1(2 * w * v, 2 * u * v, 0, 0), row2(v * v);
  Jet jet;
  Derivatives& d = jet.derivatives;
  Eigen::Index axis = 0;
  for (const auto* points : {&net.x, &net.y, &net.z}) {
    const auto at_place = [&](std::size_t i) { return Four(&(*points)[i]); };
    const auto sum = [&](std::size_t first, std::size_t second) {
      return row0 * at_place(first) + row1 * at_place(second);
    };
    std::array<double, 4> p, q;  // the net's rows: p0 p1 p2, q0 q1, q2
    (sums(sum(0, 5), sum(1, 6), sum(2, 7), Four(0.0)) + row2 * at_place(9)).store(p.data());
    (sums(sum(5, 9), sum(6, 10), sum(9, 12), Four(0.0)) + row2 * at_place(12)).store(q.data());
    constexpr double degree = BezierTriangle::degree;
    d.duu[axis] = degree * (degree - 1) * ((p[2] - p[1]) - (p[1] - p[0]));
    d.duv[axis] = degree * (degree - 1) * ((q[1] - q[0]) - (p[1] - p[0]));
    d.dvv[axis] = degree * (degree - 1) * ((q[2] - q[0]) - (q[0] - p[0]));
    const double a = w * p[0] + u * p[1] + v * q[0], b = w * p[1] + u * p[2] + v * q[1],
                 c = w * q[0] + u * q[1] + v * q[2];
    d.du[axis] = degree * (b - a);
    d.dv[axis] = degree * (c - a);
    jet.position[axis] = w * a + u * b + v * c;
    ++axis;
  }
  return jet;
}

}  // namespace shaolin
