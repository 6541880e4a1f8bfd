#pragma once
/// The Jacobian of a polynomial patch in the plane of its first two coordinates, in Bernstein form.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "bezier_quad.h"
#include "bezier_triangle.h"

namespace shaolin {

/// The product of a du and a dv control vector, as a part of a coefficient of the Jacobian.
struct JacobianTerm {
  std::size_t coefficient, du, dv;
  double weight;
};

/// All products of control vectors of du and dv (in the order of u_pairs and v_pairs). In one variable
///     B_i^m B_j^n = C(m, i) C(n, j) / C(m + n, i + j) B_(i+j)^(m+n),
/// and the like with multinomial coefficients on triangles; so each coefficient is a mean of products.
template <class Regular>
struct JacobianForm;

template <>
struct JacobianForm<BezierQuad> {
  static constexpr int coefficients = 36;
  static constexpr std::array<std::size_t, 4> corners{0, 5, 35, 30};
  static const std::vector<JacobianTerm>& terms() {
    static const std::vector<JacobianTerm> all = [] {
      constexpr double two[] = {1, 2, 1}, three[] = {1, 3, 3, 1}, five[] = {1, 5, 10, 10, 5, 1};
      std::vector<JacobianTerm> list;
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t l = 0; l < 3; ++l)
            for (std::size_t k = 0; k < 4; ++k)
              list.push_back({6 * (j + l) + i + k, 3 * j + i, 4 * l + k,
                              two[i] * three[k] / five[i + k] * (three[j] * two[l] / five[j + l])});
      return list;
    }();
    return all;
  }
};

template <>
struct JacobianForm<BezierTriangle> {
  static constexpr int coefficients = 28;
  static constexpr std::array<std::size_t, 3> corners{0, 6, 27};
  static const std::vector<JacobianTerm>& terms() {
    static const std::vector<JacobianTerm> all = [] {
      constexpr double factorial[] = {1, 1, 2, 6, 24, 120, 720};
      const auto multinomial = [&](int n, int i, int j) {
        return factorial[n] / (factorial[i] * factorial[j] * factorial[n - i - j]);
      };
      std::vector<JacobianTerm> list;
      for (int j = 0; j <= 3; ++j)
        for (int i = 0; i + j <= 3; ++i)
          for (int l = 0; l <= 3; ++l)
            for (int k = 0; k + l <= 3; ++k)
              list.push_back({BezierTriangle::index(i + k, j + l, 6), BezierTriangle::index(i, j, 3),
                              BezierTriangle::index(k, l, 3),
                              multinomial(3, i, j) * multinomial(3, k, l) / multinomial(6, i + k, j + l)});
      return list;
    }();
    return all;
  }
};

/// What the coefficients say: the Jacobian lies between them. In units of differences of control points: du and dv
/// divided by the degree.
template <class Regular>
struct JacobianBound {
  double least;            ///< the least coefficient
  double least_at_corner;  ///< the least value at a corner
  double largest_du, largest_dv;

  static JacobianBound of(const Regular& piece) {
    using Form = JacobianForm<Regular>;
    std::array<Eigen::Vector2d, Regular::u_pairs.size()> du, dv;
    JacobianBound bound{0, std::numeric_limits<double>::infinity(), 0, 0};
    for (std::size_t k = 0; k < du.size(); ++k) {
      const auto difference = [&](const auto& pair) -> Eigen::Vector2d {
        return (piece.b[pair[1]] - piece.b[pair[0]]).template head<2>();
      };
      du[k] = difference(Regular::u_pairs[k]);
      dv[k] = difference(Regular::v_pairs[k]);
      bound.largest_du = std::max(bound.largest_du, du[k].norm());
      bound.largest_dv = std::max(bound.largest_dv, dv[k].norm());
    }
    std::array<double, Form::coefficients> values{};
    for (const JacobianTerm& term : Form::terms())
      values[term.coefficient] += term.weight * (du[term.du].x() * dv[term.dv].y() - du[term.du].y() * dv[term.dv].x());
    bound.least = *std::min_element(values.begin(), values.end());
    for (const std::size_t corner : Form::corners)
      bound.least_at_corner = std::min(bound.least_at_corner, values[corner]);
    return bound;
  }
};

}  // namespace shaolin
