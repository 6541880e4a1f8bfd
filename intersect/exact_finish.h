#pragma once
/// The exact finish: the first point of a polynomial patch on a ray, by subdivision and Newton in double precision.
#include <algorithm>
#include <array>
#include <limits>

#include "../schemes/bezier_quad.h"
#include "counters.h"

namespace shaolin {

/// A point of a patch on the ray: its parameter in the patch and its distance along the ray.
struct PatchHit {
  Parameter at;
  double distance = std::numeric_limits<double>::infinity();
};

/// Finds the nearest zero of (x, y) with z in [near, far] on a Bezier patch given in a ray's frame (x, y: distances
/// from RP and CP, z: distance along the ray).
///
/// A cell of the parameter domain is dropped only on proof: its hull lies to one side of the ray, also in coordinates
/// in which the cell is nearly a unit square, or it lies beyond the nearest hit so far. Where the map (x, y) is proven
/// one to one on the cell, Newton steps projected into the cell find the zero or prove that there is none; elsewhere
/// the cell is split into four, nearest first. Points within `error` of the ray count as on it: coordinates carry that
/// much rounding. So of two patches that share an edge, at least one reports a ray that passes through the edge.
template <class Bezier>
class ExactFinish {
 public:
  ExactFinish(double error, double near, double far, RayCounters& counters)
      : error_(error), near_(near), counters_(counters) {
    best_.distance = far;
  }

  /// True if a hit was found; then hit() is the nearest.
  bool solve(const Bezier& patch) {
    visit(patch, Parameter::Zero(), 1.0, 0);
    return found_;
  }
  const PatchHit& hit() const { return best_; }

 private:
  using D = typename Bezier::DomainType;
  using Matrix = Eigen::Matrix2d;

  /// Cells this small are points: halving further changes no double in [1/2, 1].
  static constexpr int deepest = 52;
  /// A ray that runs within a surface, or along a fold, meets it in a curve; the cells around a curve are without
  /// number. Past this many, cells count as points once they are this deep: 2^-26 of the patch, where a fold is flat to
  /// 2^-52.
  static constexpr int patience = 4096;
  static constexpr int deepest_out_of_patience = 26;

  enum class Verdict { none, found, unknown };

  void visit(const Bezier& cell, const Parameter& origin, double scale, int depth);
  void split(const Bezier& cell, const Parameter& origin, double scale, int depth);
  Verdict newton(const Bezier& cell, const Matrix& flattening, double contraction, PatchHit& hit);
  void accept(const Parameter& at, double distance, const Parameter& origin, double scale);

  static Eigen::Vector2d plane(const Vec3& v) { return v.head<2>(); }

  double error_;
  double near_;
  RayCounters& counters_;
  PatchHit best_;
  bool found_ = false;
  int cells_ = 0;
};

template <class Bezier>
void ExactFinish<Bezier>::accept(const Parameter& at, double distance, const Parameter& origin, double scale) {
  // A hit counts as within the interval if rounding alone could have moved it out.
  if (distance < near_ - error_ || distance > best_.distance + (found_ ? 0 : error_)) return;
  best_ = {origin + scale * at, distance};
  found_ = true;
}

template <class Bezier>
void ExactFinish<Bezier>::visit(const Bezier& cell, const Parameter& origin, double scale, int depth) {
  ++counters_.cells;
  ++cells_;
  Vec3 low = cell.b[0], high = cell.b[0];
  for (const Vec3& p : cell.b) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  if (low.x() > error_ || high.x() < -error_ || low.y() > error_ || high.y() < -error_) return;
  if (high.z() < near_ - error_ || low.z() > best_.distance + error_) return;

  const bool is_point = depth >= deepest || (cells_ > patience && depth >= deepest_out_of_patience) ||
                        (std::max(high.x(), -low.x()) <= error_ && std::max(high.y(), -low.y()) <= error_);
  if (is_point) {
    const Parameter centre = D::centre();
    accept(centre, std::max(cell.first_order(centre).position.z(), near_), origin, scale);
    return;
  }

  Matrix jacobian;
  jacobian << plane(cell.mean_du()), plane(cell.mean_dv());
  const double determinant = jacobian.determinant();
  if (std::abs(determinant) <= 1e-12 * jacobian.col(0).norm() * jacobian.col(1).norm())
    return split(cell, origin, scale, depth);
  const Matrix flattening = jacobian.inverse();

  // The hull test again, along the cell's own axes.
  const Eigen::Vector2d slack = error_ * flattening.cwiseAbs().rowwise().sum() * (1 + 1e-10);
  Eigen::Vector2d flat_low = flattening * plane(cell.b[0]), flat_high = flat_low;
  for (const Vec3& p : cell.b) {
    const Eigen::Vector2d g = flattening * plane(p);
    flat_low = flat_low.cwiseMin(g);
    flat_high = flat_high.cwiseMax(g);
  }
  if ((flat_low.array() > slack.array()).any() || (flat_high.array() < -slack.array()).any()) return;

  // |identity - d(flattening * f)| over the cell, at most the root of the largest deviations of both hulls.
  double deviation_u = 0, deviation_v = 0;
  cell.visit_du([&](const Vec3& d) {
    deviation_u = std::max(deviation_u, (flattening * plane(d) - Eigen::Vector2d::UnitX()).squaredNorm());
  });
  cell.visit_dv([&](const Vec3& d) {
    deviation_v = std::max(deviation_v, (flattening * plane(d) - Eigen::Vector2d::UnitY()).squaredNorm());
  });
  const double contraction = std::sqrt(deviation_u + deviation_v) + 1e-9;
  if (contraction < 0.95) {
    PatchHit hit;
    const Verdict verdict = newton(cell, flattening, contraction, hit);
    if (verdict == Verdict::found) accept(hit.at, hit.distance, origin, scale);
    if (verdict != Verdict::unknown) return;
  }
  split(cell, origin, scale, depth);
}

/// On a cell where g = flattening * f has |identity - g'| <= q < 1, the map T(x) = x - g(x) brings every x nearer to a
/// zero x* of the cell: |T(x) - x*| <= q |x - x*| and |x - x*| <= |g(x)| / (1 - q). Hence a T(x) farther than
/// q |g(x)| / (1 - q) from the cell proves that there is no zero. Newton steps only choose the x to ask at.
template <class Bezier>
auto ExactFinish<Bezier>::newton(const Bezier& cell, const Matrix& flattening, double contraction, PatchHit& hit)
    -> Verdict {
  const double slack = error_ * flattening.norm() * 1.5;
  const Parameter start = D::centre();
  Parameter at = D::nearest(start - flattening * plane(cell.first_order(start).position));
  double residual_before = std::numeric_limits<double>::infinity();
  constexpr int most_steps = 12;
  for (int step = 0; step < most_steps; ++step) {
    ++counters_.newton_steps;
    const FirstOrder here = cell.first_order(at);
    const Eigen::Vector2d f = plane(here.position);
    const double residual = f.cwiseAbs().maxCoeff();
    if (residual <= error_) {
      // One more step wins the last digits; keep whichever is nearer the ray.
      if (residual >= residual_before) return Verdict::found;
      hit = {at, here.position.z()};
      residual_before = residual;
    } else if (residual_before <= error_) {
      return Verdict::found;
    }
    const Eigen::Vector2d g = flattening * f;
    const Parameter image = at - g;
    const double reach = contraction * g.norm() / (1 - contraction) + slack;
    if (residual > error_ && (image - D::nearest(image)).norm() > reach * (1 + 1e-10)) return Verdict::none;

    Matrix jacobian;
    jacobian << plane(here.du), plane(here.dv);
    const Parameter next = D::nearest(at - jacobian.inverse() * f);
    if (next == at || !next.allFinite()) return residual <= error_ ? Verdict::found : Verdict::unknown;
    if (residual > error_) residual_before = std::numeric_limits<double>::infinity();
    at = next;
  }
  return residual_before <= error_ ? Verdict::found : Verdict::unknown;
}

template <class Bezier>
void ExactFinish<Bezier>::split(const Bezier& cell, const Parameter& origin, double scale, int depth) {
  const std::array<Bezier, 4> children = cell.split();
  std::array<std::pair<double, int>, 4> order;
  for (std::size_t k = 0; k < 4; ++k) {
    double nearest = children[k].b[0].z();
    for (const Vec3& p : children[k].b) nearest = std::min(nearest, p.z());
    order[k] = {nearest, static_cast<int>(k)};
  }
  std::sort(order.begin(), order.end());
  for (const auto& [distance, k] : order) {
    const Parameter child_origin = origin + scale * D::to_parent(k, Parameter::Zero());
    visit(children[static_cast<std::size_t>(k)], child_origin, scale * D::scale(k), depth + 1);
  }
}

}  // namespace shaolin
