#pragma once
/// Whether a map of a cell to the plane is nearly the identity: then it has one zero at most.
#include <algorithm>
#include <array>
#include <cmath>
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

/// For g given by its control values, by those of its derivatives: with a_ij the largest |1 - dg_i/dj| or |dg_i/dj| of
/// them, any weights w bound the norm by the larger of (a_i1 w_1 + a_i2 w_2) / w_i. The least such bound, the spectral
/// radius of a (Perron), has both equal. Of a cell that is far longer one way than the other g of the short way varies
/// with the long one many times as much as the reverse; weights take that out, where the Euclidean norm does not: on a
/// car's creases they leave a fifth of the splits. The roundings of some 10 u a value are far below the 1e-9 added.
template <class Bezier>
Contraction contraction(const std::array<double, 16>& x, const std::array<double, 16>& y) {
  constexpr double degree = Bezier::degree;
  // Rows of quads are registers: their differences among each other go along v, those of their places along u. Of
  // triangles registers hold rows of 5, 4, 3 and 2 points, or parts of two; what is a difference across rows is masked.
  const Four scale(degree), one(1);
  Four most_xu(0.0), most_yu(0.0), most_xv(0.0), most_yv(0.0);
  const auto along_u = [&](Four dx, Four dy, Four mask) {
    most_xu = larger(abs(mask * (scale * dx - one)), most_xu);
    most_yu = larger(abs(mask * (scale * dy)), most_yu);
  };
  const auto along_v = [&](Four dx, Four dy, Four mask) {
    most_xv = larger(abs(mask * (scale * dx)), most_xv);
    most_yv = larger(abs(mask * (scale * dy - one)), most_yv);
  };
  const auto step = [](const std::array<double, 16>& p, std::size_t from, std::size_t to) {
    return Four(&p[to]) - Four(&p[from]);
  };
  const Four all(1), first_three(1, 1, 1, 0), two_and_last(1, 1, 0, 1);
  if constexpr (std::is_same_v<Bezier, BezierQuad>) {
    for (std::size_t j = 0; j < 16; j += 4) {
      const Four xj(&x[j]), yj(&y[j]);
      along_u(rotated(xj) - xj, rotated(yj) - yj, first_three);
      if (j < 12) along_v(step(x, j, j + 4), step(y, j, j + 4), all);
    }
  } else {
    along_u(step(x, 0, 1), step(y, 0, 1), all);
    along_u(step(x, 5, 6), step(y, 5, 6), first_three);
    along_u(step(x, 9, 10), step(y, 9, 10), two_and_last);  // with 12 to 13
    along_v(step(x, 0, 5), step(y, 0, 5), all);
    along_v(step(x, 5, 9), step(y, 5, 9), first_three);
    along_v(step(x, 9, 12), step(y, 9, 12), two_and_last);  // with 12 to 15, the last point's second place
  }
  const auto largest = [](Four four) {
    std::array<double, 4> v;
    four.store(v.data());
    return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
  };
  const double xu = largest(most_xu), yu = largest(most_yu), xv = largest(most_xv), yv = largest(most_yv);
  // Equal weights are as good where they leave little.
  constexpr double little = 0.5, most = 0x1p20;
  double ratio = 1;  // of the weight of v to that of u
  if (std::max(xu + xv, yu + yv) > little) {
    const double root = std::sqrt((xu - yv) * (xu - yv) + 4 * xv * yu);
    ratio = xu > yv ? 2 * yu / (xu - yv + root) : (yv - xu + root) / (2 * xv);
    ratio = ratio > 1 / most ? std::min(ratio, most) : 1 / most;
  }
  const double share = std::max(xu + xv * ratio, yv + yu / ratio) + 1e-9;
  Contraction result{share, ratio < 1 ? Parameter(1, ratio) : Parameter(1 / ratio, 1), {}};
  result.most << xu, xv, yu, yv;
  return result;
}

}  // namespace shaolin
