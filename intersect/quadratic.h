#pragma once
/// Quadratic functions of a parameter, and where in a domain they are least.
#include <algorithm>
#include <array>

#include "../schemes/domain.h"

namespace shaolin {

/// A symmetric matrix of second derivatives along u and v.
struct Hessian {
  double uu, uv, vv;

  double determinant() const { return uu * vv - uv * uv; }
  bool is_positive() const { return uu > 0 && determinant() > 0; }
  Eigen::Vector2d operator*(const Eigen::Vector2d& step) const {
    return {uu * step.x() + uv * step.y(), uv * step.x() + vv * step.y()};
  }
};

/// f(at + step) - f(at) = gradient . step + step . hessian step / 2.
struct Quadratic {
  Parameter at;
  Eigen::Vector2d gradient;
  Hessian hessian;

  double change(const Eigen::Vector2d& step) const { return step.dot(gradient + 0.5 * (hessian * step)); }
};

/// A place, and what a quadratic function's value there is less than at its own place; change <= 0.
struct Lowest {
  Parameter at;
  double change;
};

/// Where in the domain, which holds f.at, the function is least. Where it is not convex, or its bottom lies outside,
/// that is on a side: there it is a quadratic of one variable, least at its bottom or at an end. Changes come from
/// steps, not from differences of values, so that they have as many digits as the steps.
template <class D>
Lowest lowest(const Quadratic& f) {
  if (f.hessian.is_positive()) {
    const Hessian& h = f.hessian;
    const Eigen::Vector2d& g = f.gradient;
    const double scale = -1 / h.determinant();
    const Eigen::Vector2d step(scale * (h.vv * g.x() - h.uv * g.y()), scale * (h.uu * g.y() - h.uv * g.x()));
    if (D::contains(f.at + step)) return {f.at + step, 0.5 * g.dot(step)};
  }
  Lowest best{f.at, 0};
  for (std::size_t i = 0; i < D::corner_count; ++i) {
    const auto &corner = D::corners[i], &next = D::corners[(i + 1) % D::corner_count];
    const Parameter from(corner[0], corner[1]), along(next[0] - corner[0], next[1] - corner[1]);
    const double first = along.dot(f.gradient + f.hessian * (from - f.at)), second = along.dot(f.hessian * along);
    const double t = second > 0 ? std::clamp(-first / second, 0.0, 1.0) : first + 0.5 * second < 0 ? 1 : 0;
    const Parameter at = D::nearest(from + t * along);
    if (const double change = f.change(at - f.at); change < best.change) best = {at, change};
  }
  return best;
}

}  // namespace shaolin
