#pragma once
/// Whether a map of a cell to the plane is nearly the identity: then it has one zero at most.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "../schemes/bezier_quad.h"
#include "../schemes/domain.h"
#include "four.h"

namespace shaolin {

/// A bound of |identity - g'| over a cell, in the norm |p| = max(|u| / weight of u, |v| / weight of v), of which the
/// larger weight is 1.
struct Contraction {
  double share;
  Parameter weights;
  Eigen::Matrix2d most;  ///< the largest |identity - g'|, place by place
  double norm(const Parameter& p) const { return p.cwiseAbs().cwiseQuotient(weights).maxCoeff(); }
};

/// Of a coordinate of a cell, given by its control values: how far at most those of its derivatives are from given
/// ones.
struct Deviation {
  double along_u, along_v;
};
template <class Bezier>
Deviation deviation(const std::array<double, 16>& x, double du, double dv) {
  constexpr double degree = Bezier::degree;
  // Rows of quads are registers: their differences among each other go along v, those of their places along u. Of
  // triangles registers hold rows of 5, 4, 3 and 2 points, or parts of two; what is a difference across rows is masked.
  const Four scale(degree), u_is(du), v_is(dv);
  Four most_u(0.0), most_v(0.0);
  const auto along_u = [&](Four step, Four mask) { most_u = larger(abs(mask * (scale * step - u_is)), most_u); };
  const auto along_v = [&](Four step, Four mask) { most_v = larger(abs(mask * (scale * step - v_is)), most_v); };
  const auto step = [&](std::size_t from, std::size_t to) { return Four(&x[to]) - Four(&x[from]); };
  const Four all(1), first_three(1, 1, 1, 0), two_and_last(1, 1, 0, 1);
  if constexpr (std::is_same_v<Bezier, BezierQuad>) {
    for (std::size_t j = 0; j < 16; j += 4) {
      const Four row(&x[j]);
      along_u(rotated(row) - row, first_three);
      if (j < 12) along_v(step(j, j + 4), all);
    }
  } else {
    along_u(step(0, 1), all);
    along_u(step(5, 6), first_three);
    along_u(step(9, 10), two_and_last);  // with 12 to 13
    along_v(step(0, 5), all);
    along_v(step(5, 9), first_three);
    along_v(step(9, 12), two_and_last);  // with 12 to 15, the last point's second place
  }
  const auto largest = [](Four four) {
    std::array<double, 4> v;
    four.store(v.data());
    return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
  };
  return {largest(most_u), largest(most_v)};
}

/// Any weights w bound the norm by the larger of (a_i1 w_1 + a_i2 w_2) / w_i. The least such bound, the spectral radius
/// of a (Perron), has both equal. Of a cell that is far longer one way than the other g of the short way varies with
/// the long one many times as much as the reverse; weights take that out, where the Euclidean norm does not: on a car's
/// creases they leave a fifth of the splits. The roundings of some 10 u a value are far below the 1e-9 added.
inline Contraction contraction(const Eigen::Matrix2d& a) {
  const double xu = a(0, 0), xv = a(0, 1), yu = a(1, 0), yv = a(1, 1);
  // Equal weights are as good where they leave little.
  constexpr double little = 0.5, most = 0x1p20;
  double ratio = 1;  // of the weight of v to that of u
  if (std::max(xu + xv, yu + yv) > little) {
    const double root = std::sqrt((xu - yv) * (xu - yv) + 4 * xv * yu);
    ratio = xu > yv ? 2 * yu / (xu - yv + root) : (yv - xu + root) / (2 * xv);
    ratio = ratio > 1 / most ? std::min(ratio, most) : 1 / most;
  }
  const double share = std::max(xu + xv * ratio, yv + yu / ratio) + 1e-9;
  return {share, ratio < 1 ? Parameter(1, ratio) : Parameter(1 / ratio, 1), a};
}

/// For g given by its control values, by those of its derivatives.
template <class Bezier>
Contraction contraction(const std::array<double, 16>& x, const std::array<double, 16>& y) {
  const Deviation of_x = deviation<Bezier>(x, 1, 0), of_y = deviation<Bezier>(y, 0, 1);
  Eigen::Matrix2d most;
  most << of_x.along_u, of_x.along_v, of_y.along_u, of_y.along_v;
  return contraction(most);
}

/// A zero of g is looked for by a Newton step from a place where g and its derivative, `slope`, are given: how far at
/// most the zero of the exact map lies from where the step leads; infinite if the contraction principle proves none.
/// `moved`: by how much g may differ from the exact map, flattened in the same way.
///
/// The exact map's control values differ from the given ones by at most an error, and its derivatives, differences of
/// control values times a degree of at most 4, by 8 errors. So that it has one zero in the cell at most, if its
/// derivative stays within q < 1 of the identity: g' moves by 8 s_i, with s = `moved`.
///
/// Where it is, x - J^-1 F(x) says, with J the slope and F the exact map, which takes the rectangle at the step's end
/// +- r into itself: second derivatives of J^-1 g are at most 6 |J^-1| a, as those of g are differences of values
/// within a_ij of each other's centre, times at most 3. At the middle that leaves b = |J^-1 (g + J step)|
/// + 3 |J^-1| a |step| |step|_1 + |J^-1| s (1 + 8 |step|_1), and the derivative of the map is at most
/// C = 6 |J^-1| a |step and r|_1 + 8 |J^-1| s. r = 5/4 b it is if C r <= b / 4. The rectangle may leave the cell by
/// 2^-10: there the control values of identity - g', of degree at most 6, grow by (1 + 4 * 2^-10)^6 < 1.024. Then there
/// is the rounding of the parameters, 2^-52.
inline Parameter zero_radius(const Eigen::Vector2d& g, const Eigen::Matrix2d& slope, const Eigen::Vector2d& step,
                             const Contraction& contraction, const Parameter& moved) {
  const double q = 1.024 * (contraction.share + 8 * contraction.weights.sum() * contraction.norm(moved));
  const Eigen::Matrix2d inverse = slope.inverse(), size = inverse.cwiseAbs();
  const Parameter off_by = size * moved;
  const Eigen::Matrix2d bend = 6 * 1.024 * size * contraction.most;
  const double length = step.lpNorm<1>();
  const Parameter off =
      (inverse * (g + slope * step)).cwiseAbs() + 0.5 * length * (bend * step.cwiseAbs()) + (1 + 8 * length) * off_by;
  const Parameter radius = 1.25 * off;
  const Parameter varies = (length + radius.sum()) * (bend * radius) + 8 * radius.sum() * off_by;
  const bool is_proven = q < 1 && (varies.array() <= 0.25 * off.array()).all() && (radius.array() <= 0x1p-10).all();
  return is_proven ? Parameter(radius.array() + 0x1p-52)
                   : Parameter(Parameter::Constant(std::numeric_limits<double>::infinity()));
}

}  // namespace shaolin
