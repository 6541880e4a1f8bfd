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
  explicit NetEvaluation(const Parameter& at) : u_(CubicWeights::of_bezier(at.x())), v_(at.y()) {}

  Four operator()(const std::array<double, 16>& points) const {
    const detail::AlongColumns along_v{Four(&points[0]), Four(&points[4]), Four(&points[8]), Four(&points[12])};
    const Four value = along_v(v_.value);
    return sums(u_.value * value, u_.first * value, u_.value * along_v(v_.first), Four(0.0));
  }

 private:
  CubicWeights u_;
  BezierQuad::Bernstein v_;
};

/// By the cubics on the triangle: with their sums A, B and C over the points, over the next ones along u and over those
/// along v, which are its points after three steps of de Casteljau's, the value is w A + u B + v C. Rows of the net
/// have 5, 4, 3, 2 and 1 points, and its last place repeats the last point.
template <>
class NetEvaluation<BezierTriangle> {
 public:
  explicit NetEvaluation(const Parameter& at) : u_(at.x()), v_(at.y()), w_(1 - u_ - v_) {}

  Four operator()(const std::array<double, 16>& points) const { return (*this)(points.data()); }
  Four operator()(const double* points) const {
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

/// A patch's polynomial at one parameter: vectors (x, y, z, 0).
template <class Bezier>
class PatchEvaluation;

template <>
class PatchEvaluation<BezierQuad> {
 public:
  PatchEvaluation(const SplineWindow<BezierQuad>& patch, const Parameter& at)
      : u_(patch.to_bezier().u_weights(at.x())) {
    const CubicWeights v = patch.to_bezier().v_weights(at.y());
    value_ = along_v(patch, v.value);
    first_ = along_v(patch, v.first);
  }

  Four position() const { return along_u(u_.value, value_); }
  Four du() const { return along_u(u_.first, value_); }
  Four dv() const { return along_u(u_.value, first_); }

 private:
  using Columns = std::array<Four, 3>;  ///< sums along v of each coordinate

  static Columns along_v(const SplineWindow<BezierQuad>& patch, Four weights) {
    std::array<double, 4> w;
    weights.store(w.data());
    const auto column = [&](std::size_t axis) {
      return detail::AlongColumns{patch.row(axis, 0), patch.row(axis, 1), patch.row(axis, 2), patch.row(axis, 3)}(w);
    };
    return {column(0), column(1), column(2)};
  }
  static Four along_u(Four weights, const Columns& of) {
    return sums(weights * of[0], weights * of[1], weights * of[2], Four(0.0));
  }

  CubicWeights u_;
  Columns value_{Four(0.0), Four(0.0), Four(0.0)}, first_ = value_;
};

template <>
class PatchEvaluation<BezierTriangle> {
 public:
  PatchEvaluation(const SplineWindow<BezierTriangle>& patch, const Parameter& at) {
    const NetEvaluation<BezierTriangle> evaluation(at);
    for (std::size_t axis = 0; axis < 3; ++axis) columns_[axis] = evaluation(patch.first() + 16 * axis);
    transpose(columns_[0], columns_[1], columns_[2], columns_[3]);  // from (value, du, dv, 0) each
  }

  Four position() const { return columns_[0]; }
  Four du() const { return columns_[1]; }
  Four dv() const { return columns_[2]; }

 private:
  std::array<Four, 4> columns_{Four(0.0), Four(0.0), Four(0.0), Four(0.0)};
};

/// A polynomial's position and its derivatives up to the second.
struct Jet {
  Vec3 position;
  Derivatives derivatives;
};

inline Jet jet(const SplineWindow<BezierQuad>& patch, const Parameter& at) {
  const CubicWeights u = patch.to_bezier().u_weights(at.x()), v = patch.to_bezier().v_weights(at.y());
  std::array<double, 4> v_value, v_first, v_second;
  v.value.store(v_value.data());
  v.first.store(v_first.data());
  v.second.store(v_second.data());
  Jet jet;
  Derivatives& d = jet.derivatives;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const auto coordinate = static_cast<std::size_t>(axis);
    const detail::AlongColumns along_v{patch.row(coordinate, 0), patch.row(coordinate, 1), patch.row(coordinate, 2),
                                       patch.row(coordinate, 3)};
    const Four of_value = along_v(v_value), of_first = along_v(v_first), of_second = along_v(v_second);
    std::array<double, 4> low, high;
    sums(u.value * of_value, u.first * of_value, u.value * of_first, u.first * of_first).store(low.data());
    sums(u.second * of_value, u.value * of_second, Four(0.0), Four(0.0)).store(high.data());
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
