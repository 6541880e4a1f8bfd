#pragma once
/// The regular patch of Catmull-Clark: a bicubic polynomial, in Bezier form.
#include <array>
#include <cstdint>

#include "domain.h"
#include "limit_sample.h"

namespace shaolin {

/// Sixteen Bezier points, b[4 j + i] at u = i / 3, v = j / 3. The surface lies in their convex hull.
struct BezierQuad {
  using DomainType = Domain<FaceKind::quad>;
  static constexpr int size = 16;
  static constexpr int degree = 3;
  static constexpr int spline_size = 16;
  static constexpr std::array<std::size_t, 4> corners{0, 3, 15, 12};
  std::array<Vec3, size> b;

  /// From the 4 x 4 control points of a uniform bicubic B-spline, p[4 j + i], whose patch lies over the middle square:
  /// per direction (1, 4, 1)/6, (4, 2)/6, (2, 4)/6, (1, 4, 1)/6.
  static BezierQuad from_spline(const std::array<Vec3, spline_size>& p) {
    BezierQuad along_u, result;
    for (std::size_t j = 0; j < 4; ++j) cubic_to_bezier(&p[4 * j], &along_u.b[4 * j], 1);
    for (std::size_t i = 0; i < 4; ++i) cubic_to_bezier(&along_u.b[i], &result.b[i], 4);
    return result;
  }

  /// Along one direction: four Bezier points = matrix * four others.
  struct LineMap {
    Eigen::Matrix4d matrix;
    enum class Kind { identity, spline, other } kind;
  };
  /// Along both: Bezier points = v P u^T, coordinate by coordinate, of 4 x 4 points P in rows along u.
  struct Maps {
    LineMap u, v;
  };

  static LineMap identity_map() { return {Eigen::Matrix4d::Identity(), LineMap::Kind::identity}; }
  /// What from_spline() does.
  static LineMap spline_map() {
    LineMap map{{}, LineMap::Kind::spline};
    map.matrix << 1, 4, 1, 0, 0, 4, 2, 0, 0, 2, 4, 0, 0, 1, 4, 1;
    map.matrix /= 6;
    return map;
  }

  /// The bilinear patch over the first four points, its corners in order (cubic by raising the degree: thirds along
  /// each side).
  static BezierQuad from_corners(const std::array<Vec3, spline_size>& p) {
    BezierQuad result;
    for (std::size_t j = 0; j < 4; ++j) {
      const double v = static_cast<double>(j) / 3;
      const Vec3 first = (1 - v) * p[0] + v * p[3], last = (1 - v) * p[1] + v * p[2];
      for (std::size_t i = 0; i < 4; ++i) {
        const double u = static_cast<double>(i) / 3;
        result.b[4 * j + i] = (1 - u) * first + u * last;
      }
    }
    return result;
  }

  /// The cubic Bernstein polynomials and their derivatives.
  struct Bernstein {
    std::array<double, 4> value, first, second;
    explicit Bernstein(double t) {
      const double s = 1 - t;
      value = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
      first = {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
      second = {6 * s, 6 * (t - 2 * s), 6 * (s - 2 * t), 6 * t};
    }
  };

  Vec3 position(const Parameter& at) const {
    const Bernstein u(at.x()), v(at.y());
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) sum += v.value[j] * combine(u.value, j);
    return sum;
  }

  Derivatives derivatives(const Parameter& at) const {
    const Bernstein u(at.x()), v(at.y());
    Derivatives d{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 row = combine(u.value, j), row_du = combine(u.first, j);
      d.du += v.value[j] * row_du;
      d.dv += v.first[j] * row;
      d.duu += v.value[j] * combine(u.second, j);
      d.duv += v.first[j] * row_du;
      d.dvv += v.second[j] * row;
    }
    return d;
  }

  /// The halves in u (axis 0) or v (axis 1), the lower one first (de Casteljau at 1/2: midpoints only).
  std::array<BezierQuad, 2> halves(int axis) const {
    const std::size_t along = axis == 0 ? 1 : 4, across = axis == 0 ? 4 : 1;
    std::array<BezierQuad, 2> half;
    for (std::size_t i = 0; i < 4 * across; i += across) halve(&b[i], &half[0].b[i], &half[1].b[i], along);
    return half;
  }

  /// The four quarters, in the order of Domain<quad>.
  std::array<BezierQuad, 4> split() const {
    const std::array<BezierQuad, 2> half = halves(0), low = half[0].halves(1), high = half[1].halves(1);
    return {low[0], high[0], high[1], low[1]};
  }

  /// The part over the rectangle between two corners, lower and upper.
  BezierQuad restricted(const Parameter& lower, const Parameter& upper) const {
    BezierQuad along_u, result;
    for (std::size_t j = 0; j < 4; ++j) restrict_line(&b[4 * j], &along_u.b[4 * j], 1, lower.x(), upper.x());
    for (std::size_t i = 0; i < 4; ++i) restrict_line(&along_u.b[i], &result.b[i], 4, lower.y(), upper.y());
    return result;
  }

  /// Pairs (from, to) of neighbouring control points: degree x their differences are the control points of the u
  /// derivative, and of the v derivative, whose hulls hold the derivatives.
  using Pair = std::array<std::uint8_t, 2>;
  static constexpr std::array<Pair, 12> u_pairs{
      {{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}, {6, 7}, {8, 9}, {9, 10}, {10, 11}, {12, 13}, {13, 14}, {14, 15}}};
  static constexpr std::array<Pair, 12> v_pairs{
      {{0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 8}, {5, 9}, {6, 10}, {7, 11}, {8, 12}, {9, 13}, {10, 14}, {11, 15}}};

  /// By the axes of halves().
  static constexpr std::array<std::array<Pair, 12>, 2> side_pairs{u_pairs, v_pairs};

  /// Derivatives of the mean plane, from the corners; per coordinate or for points.
  template <class Value>
  static Value mean_du(const std::array<Value, 16>& p) {
    return 0.5 * ((p[3] - p[0]) + (p[15] - p[12]));
  }
  template <class Value>
  static Value mean_dv(const std::array<Value, 16>& p) {
    return 0.5 * ((p[12] - p[0]) + (p[15] - p[3]));
  }

  /// What each control point weighs in the position and the first derivatives at a parameter.
  struct Weights {
    std::array<double, 16> value, du, dv;
  };
  static Weights weights(const Parameter& at) {
    const Bernstein u(at.x()), v(at.y());
    Weights w;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) {
        w.value[4 * j + i] = v.value[j] * u.value[i];
        w.du[4 * j + i] = v.value[j] * u.first[i];
        w.dv[4 * j + i] = v.first[j] * u.value[i];
      }
    return w;
  }

 private:
  Vec3 combine(const std::array<double, 4>& w, std::size_t row) const {
    return w[0] * b[4 * row] + w[1] * b[4 * row + 1] + w[2] * b[4 * row + 2] + w[3] * b[4 * row + 3];
  }

  static void cubic_to_bezier(const Vec3* p, Vec3* out, std::size_t stride) {
    const Vec3& p1 = p[stride];
    const Vec3& p2 = p[2 * stride];
    out[0] = (p[0] + 4 * p1 + p2) / 6;
    out[stride] = (2 * p1 + p2) / 3;
    out[2 * stride] = (p1 + 2 * p2) / 3;
    out[3 * stride] = (p1 + 4 * p2 + p[3 * stride]) / 6;
  }

  /// The cubic's part from one place to another: its blossom at three, two, one and none of the first.
  static void restrict_line(const Vec3* p, Vec3* out, std::size_t stride, double from, double to) {
    for (int k = 0; k < 4; ++k) {
      std::array<Vec3, 4> line{p[0], p[stride], p[2 * stride], p[3 * stride]};
      for (std::size_t n = 3; n > 0; --n) {
        const double t = static_cast<int>(n) <= k ? to : from;
        for (std::size_t i = 0; i < n; ++i) line[i] = (1 - t) * line[i] + t * line[i + 1];
      }
      out[static_cast<std::size_t>(k) * stride] = line[0];
    }
  }

  static void halve(const Vec3* p, Vec3* low, Vec3* high, std::size_t stride) {
    const Vec3 m01 = 0.5 * (p[0] + p[stride]);
    const Vec3 m12 = 0.5 * (p[stride] + p[2 * stride]);
    const Vec3 m23 = 0.5 * (p[2 * stride] + p[3 * stride]);
    const Vec3 left = 0.5 * (m01 + m12);
    const Vec3 right = 0.5 * (m12 + m23);
    low[0] = p[0];
    low[stride] = m01;
    low[2 * stride] = left;
    low[3 * stride] = high[0] = 0.5 * (left + right);
    high[stride] = right;
    high[2 * stride] = m23;
    high[3 * stride] = p[3 * stride];
  }
};

}  // namespace shaolin
