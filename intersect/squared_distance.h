#pragma once
/// How far a polynomial patch is from the origin, squared: a polynomial of twice the degree, in Bernstein form.
#include <array>
#include <type_traits>

#include "../schemes/bezier_quad.h"
#include "../schemes/bezier_triangle.h"
#include "net.h"
#include "quadratic.h"

namespace shaolin {

/// The Bernstein coefficients of F = |S|^2 - |a|^2, for S with the given net and a point a near it. F and its second
/// derivatives are nowhere below the least of their coefficients.
///
/// With s = S - a it is s . s + 2 a . s, so what rounding does is small against the patch, not against the distance.
/// Coefficients times their binomials are those of a power series: a product's are sums of products (Farouki and Rajan,
/// "Algorithms for polynomials in Bernstein form", 1988).
template <class Bezier>
class SquaredDistance {
 public:
  SquaredDistance(const Net& net, const Vec3& near);

  /// A lower bound of F.
  double least() const { return least_ - error_; }

  /// A matrix that all second derivatives of F exceed by a positive semidefinite one: f(x + d) >= f(x) + f'(x) d +
  /// d^T B d / 2 while x and x + d are in the domain.
  Hessian below() const;

 private:
  static constexpr bool quad = std::is_same_v<Bezier, BezierQuad>;
  static constexpr int degree = 2 * Bezier::degree;
  /// Of a net: its rows, padded to fours; of F: its rows with room for what they overlap.
  static constexpr std::size_t rows = Bezier::degree + 1, width = quad ? 4 : 8, stride = quad ? 8 : 16;
  static constexpr std::size_t size = (degree + 1) * stride;
  static constexpr std::size_t length(std::size_t row) { return quad ? rows : rows - row; }

  using Padded = std::array<double, rows * width>;
  using Product = std::array<double, size>;
  struct Tables {
    Padded binomials{};  ///< of the patch
    Product inverses{};  ///< of the product's
    Tables();
  };
  static inline const Tables tables;

  static double binomial(int n, int k) {
    double result = 1;
    for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
    return result;
  }
  static double binomial(int n, int i, int j) {
    return quad ? binomial(n, i) * binomial(n, j) : binomial(n, i) * binomial(n - i, j);
  }
  static Padded padded(const std::array<double, 16>& coordinate, double minus) {
    Padded result{};
    std::size_t from = 0;
    for (std::size_t j = 0; j < rows; ++j)
      for (std::size_t i = 0; i < length(j); ++i) result[width * j + i] = coordinate[from++] - minus;
    return result;
  }
  double at(int i, int j) const { return values_[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)]; }
  static int last(int j, int n) { return quad ? n : n - j; }

  Product values_{};
  double least_, error_;
  double along_u_, along_v_;  ///< sizes of derivatives: how steps along u and v compare
};

template <class Bezier>
SquaredDistance<Bezier>::Tables::Tables() {
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < length(j); ++i)
      binomials[width * j + i] = binomial(Bezier::degree, static_cast<int>(i), static_cast<int>(j));
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= last(j, degree); ++i)
      inverses[stride * static_cast<std::size_t>(j) + static_cast<std::size_t>(i)] = 1 / binomial(degree, i, j);
}

/// A coefficient is a mean of products of which each has four terms, below 2 (h^2 + |a| h) with h the largest |s|; its
/// weights are good to 4 u, its terms to 4 u, and up to 64 are summed in rows of 16: 32 u in all.
///
/// Sums go from number to number, not by Four: the rows that are summed overlap, and GCC 12 at -O3 carries the wrong
/// pairs over from one step to the next where they are pairs of an SSE2 register (-fpredictive-commoning).
template <class Bezier>
SquaredDistance<Bezier>::SquaredDistance(const Net& net, const Vec3& near)
    : along_u_(Vec3(Bezier::mean_du(net.x), Bezier::mean_du(net.y), Bezier::mean_du(net.z)).norm()),
      along_v_(Vec3(Bezier::mean_dv(net.x), Bezier::mean_dv(net.y), Bezier::mean_dv(net.z)).norm()) {
  Padded x = padded(net.x, near.x()), y = padded(net.y, near.y()), z = padded(net.z, near.z()), along;
  double farthest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double weight = tables.binomials[i];
    farthest = std::max(farthest, weight > 0 ? x[i] * x[i] + y[i] * y[i] + z[i] * z[i] : 0);
    along[i] = weight * (2 * (near.x() * x[i] + near.y() * y[i] + near.z() * z[i]));
    x[i] *= weight;
    y[i] *= weight;
    z[i] *= weight;
  }
  for (std::size_t ja = 0; ja < rows; ++ja)
    for (std::size_t ia = 0; ia < length(ja); ++ia) {
      const std::size_t a = width * ja + ia;
      for (std::size_t jb = 0; jb < rows; ++jb) {
        const std::size_t row = width * jb;
        double* const to = &values_[stride * (ja + jb) + ia];
        for (std::size_t ib = 0; ib < length(jb); ++ib) {
          const std::size_t b = row + ib;
          to[ib] += (x[a] * x[b] + y[a] * y[b]) + (z[a] * z[b] + along[a] * tables.binomials[b]);
        }
      }
    }
  const double h = std::sqrt(farthest);
  error_ = 64 * unit_roundoff * (farthest + near.norm() * h);
  least_ = std::numeric_limits<double>::infinity();
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= last(j, degree); ++i) {
      double& value = values_[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
      value *= tables.inverses[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
      least_ = std::min(least_, value);
    }
}

/// Second derivatives along u and v are at least the least of their coefficients, the mixed ones within a d of the
/// middle of theirs. A change of these by d takes from a step (x, y) at most 2 d |x y| <= d (r x^2 + y^2 / r), for any
/// r: for the one that weighs steps by how far they lead.
template <class Bezier>
Hessian SquaredDistance<Bezier>::below() const {
  constexpr double factor = degree * (degree - 1), mixed = quad ? degree * degree : factor;
  double uu = std::numeric_limits<double>::infinity(), vv = uu, uv_low = uu, uv_high = -uu;
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= last(j, degree) - 2; ++i)
      uu = std::min(uu, (at(i + 2, j) - at(i + 1, j)) - (at(i + 1, j) - at(i, j)));
  for (int j = 0; j <= degree - 2; ++j)
    for (int i = 0; i <= last(j, quad ? degree : degree - 2); ++i)
      vv = std::min(vv, (at(i, j + 2) - at(i, j + 1)) - (at(i, j + 1) - at(i, j)));
  for (int j = 0; j < degree; ++j)
    for (int i = 0; i <= last(j, quad ? degree - 1 : degree - 2); ++i) {
      const double value = (at(i + 1, j + 1) - at(i + 1, j)) - (at(i, j + 1) - at(i, j));
      uv_low = std::min(uv_low, value);
      uv_high = std::max(uv_high, value);
    }
  const double slack = 4 * error_;  // of a second difference
  const double spread = mixed * (0.5 * (uv_high - uv_low) + slack);
  const double ratio = along_u_ > 0 && along_v_ > 0 ? along_u_ / along_v_ : 1;
  return {factor * (uu - slack) - spread * ratio, mixed * (0.5 * (uv_low + uv_high)),
          factor * (vv - slack) - spread / ratio};
}

}  // namespace shaolin
