#pragma once
/// The regular patch of Loop's scheme: a quartic polynomial on a triangle, in Bezier form.
#include <array>
#include <cstdint>

#include "bezier_quad.h"
#include "domain.h"
#include "limit_sample.h"
#include "symmetric_sum.h"

namespace shaolin {

/// Fifteen Bezier points, b[index(i, j)] at u = i / 4, v = j / 4, i + j <= 4. The surface lies in their convex hull.
struct BezierTriangle {
  using DomainType = Domain<FaceKind::triangle>;
  static constexpr int degree = 4;
  static constexpr int size = 15;
  static constexpr int spline_size = 12;
  static constexpr std::array<std::size_t, 3> corners{0, 4, 14};
  std::array<Vec3, size> b;

  /// A net of degree n is packed by rows of constant j: n + 1 points, n points, ... 1 point.
  static constexpr std::size_t index(int i, int j, int n = degree) {
    return static_cast<std::size_t>(j * (2 * n + 3 - j) / 2 + i);
  }

  /// From the twelve control points of a three-directional quartic box spline: the corners p[0..2]; p[3 + k] across the
  /// edge from corner k to the next; p[6 + 2 k], p[7 + 2 k] the other two neighbours of corner k, counter-clockwise.
  ///
  /// Counter-clockwise around corner a with the next corner b: b, l (the third corner), a1, a2, a3, r. Then
  ///   limit point         (6 a + b + l + a1 + a2 + a3 + r) / 12,
  ///   towards b           (6 a + 2 b + 3/2 (l + r) + 1/2 (a1 + a3)) / 12,   middle of a-b  (2 a + 2 b + l + r) / 6,
  ///   inside, nearest a   (10 a + 6 (b + l) + (opposites across both edges at a)) / 24
  /// (Mueller et al. 2003, section 4; the last from the terms u^2 v w of the box spline's basis in Stam 1999).
  static BezierTriangle from_spline(const std::array<Vec3, spline_size>& p);

  /// The flat patch over the first three points, its corners in order (quartic by raising the degree: quarters along
  /// each side; sums of exact quarters, so that neighbours agree on a shared side).
  static BezierTriangle from_corners(const std::array<Vec3, spline_size>& p) {
    BezierTriangle result;
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i + j <= degree; ++i)
        result.b[index(i, j)] = 0.25 * (((degree - i - j) * p[0] + i * p[1]) + j * p[2]);
    return result;
  }

  Vec3 position(const Parameter& at) const {
    Net net = b;
    for (int n = degree; n > 0; --n) casteljau(net, n, at);
    return net[0];
  }

  Derivatives derivatives(const Parameter& at) const {
    Net net = b;
    for (int n = degree; n > 2; --n) casteljau(net, n, at);
    constexpr double second = degree * (degree - 1);
    Derivatives d;
    d.duu = second * ((net[2] - net[1]) - (net[1] - net[0]));
    d.duv = second * ((net[4] - net[3]) - (net[1] - net[0]));
    d.dvv = second * ((net[5] - net[3]) - (net[3] - net[0]));
    casteljau(net, 2, at);
    d.du = degree * (net[1] - net[0]);
    d.dv = degree * (net[2] - net[0]);
    return d;
  }

  /// The four quarters, in the order of Domain<triangle> (de Casteljau at the edge midpoints).
  std::array<BezierTriangle, 4> split() const {
    return {corner_child(0), corner_child(1), corner_child(2), middle_child()};
  }

  /// The halves on both sides of the line from the middle of a side (0 from the first corner to the second, and so on)
  /// to the opposite corner; the one at the side's start first. Each keeps two of the corners in their places, and has
  /// the middle in the third.
  std::array<BezierTriangle, 2> halves(int side) const;

  /// The part over the triangle with these corners: the blossom at each as often as its exponent says.
  BezierTriangle restricted(const std::array<Parameter, 3>& to) const {
    BezierTriangle result;
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i + j <= degree; ++i) {
        Net net = b;
        for (int n = degree; n > 0; --n) casteljau(net, n, to[n <= i ? 1 : n <= i + j ? 2 : 0]);
        result.b[index(i, j)] = net[0];
      }
    return result;
  }

  /// Pairs (from, to) of neighbouring control points: degree x their differences are the control points of the u
  /// derivative, and of the v derivative, whose hulls hold the derivatives.
  using Pair = std::array<std::uint8_t, 2>;
  static constexpr std::array<Pair, 10> u_pairs{
      {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {5, 6}, {6, 7}, {7, 8}, {9, 10}, {10, 11}, {12, 13}}};
  static constexpr std::array<Pair, 10> v_pairs{
      {{0, 5}, {1, 6}, {2, 7}, {3, 8}, {5, 9}, {6, 10}, {7, 11}, {9, 12}, {10, 13}, {12, 14}}};

  /// By the sides of halves(). Across from the first corner, those of v less those of u.
  static constexpr std::array<std::array<Pair, 10>, 3> side_pairs{
      u_pairs, {{{1, 5}, {2, 6}, {3, 7}, {4, 8}, {6, 9}, {7, 10}, {8, 11}, {10, 12}, {11, 13}, {13, 14}}}, v_pairs};

  /// Derivatives of the chord triangle; per coordinate or for points.
  template <class Value, std::size_t count>
  static Value mean_du(const std::array<Value, count>& p) {
    return p[4] - p[0];
  }
  template <class Value, std::size_t count>
  static Value mean_dv(const std::array<Value, count>& p) {
    return p[14] - p[0];
  }

  /// What each control point weighs in the position and the first derivatives at a parameter; one place is unused.
  struct Weights {
    std::array<double, 16> value, du, dv;
  };
  static Weights weights(const Parameter& at);

 private:
  using Net = std::array<Vec3, size>;

  /// One step from degree n to n - 1, in place.
  static void casteljau(Net& net, int n, const Parameter& at) {
    const double w = 1 - at.x() - at.y();
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i)
        net[index(i, j, n - 1)] =
            w * net[index(i, j, n)] + at.x() * net[index(i + 1, j, n)] + at.y() * net[index(i, j + 1, n)];
  }

  /// One step with the midpoint of the edge opposite corner `k` for argument.
  static Net midpoint_step(const Net& net, int n, int k) {
    Net out;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        const Vec3& first = net[k == 0 ? index(i + 1, j, n) : index(i, j, n)];
        const Vec3& second = net[k == 2 ? index(i + 1, j, n) : index(i, j + 1, n)];
        out[index(i, j, n - 1)] = 0.5 * (first + second);
      }
    return out;
  }

  /// The place of the point with exponents (e0, e1, e2), cyclically renamed so that corner k comes first.
  static constexpr std::size_t rotated(int k, int i, int j) {
    const int e0 = degree - i - j;
    return k == 0 ? index(i, j) : k == 1 ? index(e0, i) : index(j, e0);
  }

  /// The half-size triangle at corner k: means along one direction, then along the other.
  BezierTriangle corner_child(int k) const;
  /// The blossom with the three edge midpoints for arguments.
  BezierTriangle middle_child() const;
};

inline BezierTriangle BezierTriangle::from_spline(const std::array<Vec3, spline_size>& p) {
  BezierTriangle t;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k), next = (at + 1) % 3, last = (at + 2) % 3;
    const Vec3 &a = p[at], &b_next = p[next], &l = p[last];
    const Vec3 &r = p[3 + at], &a1 = p[3 + last], &a2 = p[6 + 2 * at], &a3 = p[7 + 2 * at];
    const std::array<Vec3, 6> around{b_next, l, a1, a2, a3, r};
    static constexpr std::array<int, 6> order{0, 1, 2, 3, 4, 5};
    const auto point = [&](int i, int j) -> Vec3& { return t.b[rotated(k, i, j)]; };
    point(0, 0) = (6 * a + symmetric_sum({around.data(), order.data(), 6})) / 12;
    point(1, 0) = (6 * a + 2 * b_next + 1.5 * (l + r) + 0.5 * (a1 + a3)) / 12;
    point(0, 1) = (6 * a + 2 * l + 1.5 * (a1 + b_next) + 0.5 * (a2 + r)) / 12;
    point(2, 0) = (2 * (a + b_next) + (l + r)) / 6;
    point(1, 1) = (10 * a + 6 * (b_next + l) + (a1 + r)) / 24;
  }
  return t;
}

inline BezierTriangle BezierTriangle::corner_child(int k) const {
  Net net;
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i + j <= degree; ++i) net[index(i, j)] = b[rotated(k, i, j)];
  for (int j = 0; j < degree; ++j)
    for (int pass = 1; pass + j <= degree; ++pass)
      for (int i = degree - j; i >= pass; --i) net[index(i, j)] = 0.5 * (net[index(i - 1, j)] + net[index(i, j)]);
  for (int i = 0; i < degree; ++i)
    for (int pass = 1; pass + i <= degree; ++pass)
      for (int j = degree - i; j >= pass; --j) net[index(i, j)] = 0.5 * (net[index(i, j - 1)] + net[index(i, j)]);
  BezierTriangle child;
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i + j <= degree; ++i) child.b[rotated(k, i, j)] = net[index(i, j)];
  return child;
}

inline BezierTriangle BezierTriangle::middle_child() const {
  BezierTriangle child;
  Net after0 = b;
  for (int e0 = 0; e0 <= degree; ++e0) {
    Net after1 = after0;
    for (int e1 = 0; e0 + e1 <= degree; ++e1) {
      Net point = after1;
      for (int n = degree - e0 - e1; n > 0; --n) point = midpoint_step(point, n, 2);
      child.b[index(e1, degree - e0 - e1)] = point[0];
      if (e0 + e1 < degree) after1 = midpoint_step(after1, degree - e0 - e1, 1);
    }
    if (e0 < degree) after0 = midpoint_step(after0, degree - e0, 0);
  }
  return child;
}

/// Rows along the side are curves, which de Casteljau's midpoints halve.
inline std::array<BezierTriangle, 2> BezierTriangle::halves(int side) const {
  std::array<BezierTriangle, 2> half;
  for (int j = 0; j <= degree; ++j) {
    std::array<Vec3, degree + 1> row;
    const auto at = [&](int i) -> Vec3& { return row[static_cast<std::size_t>(i)]; };
    for (int i = 0; i + j <= degree; ++i) at(i) = b[rotated(side, i, j)];
    for (int n = degree - j; n >= 0; --n) {
      half[0].b[rotated(side, degree - j - n, j)] = at(0);
      half[1].b[rotated(side, n, j)] = at(n);
      for (int i = 0; i < n; ++i) at(i) = 0.5 * (at(i) + at(i + 1));
    }
  }
  return half;
}

/// With the cubic Bernstein polynomials c on the triangle, 10 of them: the weights of the derivatives are 4 (c(i-1, j)
/// - c(i, j)) and 4 (c(i, j-1) - c(i, j)), and those of the position w c(i, j) + u c(i-1, j) + v c(i, j-1).
inline auto BezierTriangle::weights(const Parameter& at) -> Weights {
  const double u = at.x(), v = at.y(), w = 1 - u - v;
  const std::array<double, 10> cubic{w * w * w,     3 * w * w * u, 3 * w * u * u, u * u * u,     3 * w * w * v,
                                     6 * w * u * v, 3 * u * u * v, 3 * w * v * v, 3 * u * v * v, v * v * v};
  Weights result{};
  for (std::size_t k = 0; k < u_pairs.size(); ++k) {
    const auto from = u_pairs[k][0], along_u = u_pairs[k][1], along_v = v_pairs[k][1];
    result.value[from] += w * cubic[k];
    result.value[along_u] += u * cubic[k];
    result.value[along_v] += v * cubic[k];
    result.du[from] -= degree * cubic[k];
    result.du[along_u] += degree * cubic[k];
    result.dv[from] -= degree * cubic[k];
    result.dv[along_v] += degree * cubic[k];
  }
  return result;
}

}  // namespace shaolin
