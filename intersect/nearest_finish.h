#pragma once
/// The point of a polynomial patch that is nearest to the origin, by subdivision and Newton steps in double precision.
#include "box.h"
#include "flatten.h"
#include "point_approach.h"
#include "squared_distance.h"

namespace shaolin {

/// Looks for a nearer place than the approach knows on a Bezier patch whose points are relative to the query's.
///
/// With F = |S|^2, a cell of the parameter domain is dropped only on proof: its hull is too far; the hull has a plane
/// between itself and the origin that is; the Bernstein coefficients of F are too large; or a quadratic function that
/// touches F somewhere in the cell, and lies below it everywhere else, has no smaller values than are known. The latter
/// takes the touching point's gradient, and second derivatives which all of F's exceed (see SquaredDistance). Newton's
/// steps, kept inside the cell, choose the points to ask at; each may become the nearest place. Where the nearest place
/// is found so the touching function proves it, whether it is inside, on a side, or in a corner. So what steps do not
/// settle is split, nearest part first.
template <class Bezier>
class NearestFinish {
 public:
  /// The distances of points of the patch are known to within `error`.
  NearestFinish(double error, PointApproach& approach) : error_(error), approach_(approach) {}

  /// True if a nearer place was found: then it is at(), and the approach has taken it.
  bool solve(const Net& patch) {
    visit(patch, Parameter::Zero(), Parameter::Ones());
    return found_;
  }
  const Parameter& at() const { return at_; }

 private:
  using D = typename Bezier::DomainType;

  /// Cells this small are points: halving further changes no double in [1/2, 1].
  static constexpr double smallest = 0x1p-52;
  /// A patch that is collapsed to a curve has its nearest place along a line of parameters, and the cells around a line
  /// are without number. After each as many, the error counts twice as much, up to 32 times.
  static constexpr int patience = 2048;

  /// A cell's parameters p stand for origin + scale * p, per coordinate.
  void visit(const Net& cell, const Parameter& origin, const Parameter& scale);
  bool settle(const Net& cell, const Parameter& origin, const Parameter& scale);
  bool take(const Vec3& place, const Parameter& at) {
    if (!approach_.take(place, error_)) return false;
    at_ = at;
    return found_ = true;
  }
  void split(const Net& cell, const Parameter& origin, const Parameter& scale);

  double limit() const { return approach_.limit(error_ * std::exp2(std::min(5, cells_ / patience))); }
  static double hull_distance(const Net& cell);
  static double distance_along(const Net& cell, const Vec3& way);

  double error_;
  PointApproach& approach_;
  bool found_ = false;
  Parameter at_ = Parameter::Zero();
  int cells_ = 0;
};

template <class Bezier>
double NearestFinish<Bezier>::hull_distance(const Net& cell) {
  const Range x(cell.x), y(cell.y), z(cell.z);
  const auto beyond = [](const Range& r) { return std::max(std::max(r.low, -r.high), 0.0); };
  const double dx = beyond(x), dy = beyond(y), dz = beyond(z);
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

/// The distance of a plane across `way` that has all points behind it, seen from the origin; negative if none has.
template <class Bezier>
double NearestFinish<Bezier>::distance_along(const Net& cell, const Vec3& way) {
  const double length = way.norm();
  if (!(length > 0)) return 0;
  std::array<double, 16> plane, along;
  combine(way.x(), cell.x, way.y(), cell.y, plane);
  combine(1, plane, way.z(), cell.z, along);
  return Range(along).low / length;
}

template <class Bezier>
SHAOLIN_FLATTEN void NearestFinish<Bezier>::visit(const Net& cell, const Parameter& origin, const Parameter& scale) {
  ++approach_.counters.cells;
  ++cells_;
  if (hull_distance(cell) > limit() || distance_along(cell, approach_.toward()) > limit()) return;
  if (settle(cell, origin, scale) || scale.cwiseAbs().maxCoeff() <= smallest) return;
  split(cell, origin, scale);
}

/// True if no place of the cell is nearer than what is known now.
template <class Bezier>
SHAOLIN_FLATTEN bool NearestFinish<Bezier>::settle(const Net& cell, const Parameter& origin, const Parameter& scale) {
  const auto is_far = [&](double squared) { return squared > 0 && std::sqrt(squared) > limit(); };
  const Bezier patch = cell.bezier<Bezier>();
  Parameter at = D::centre();
  std::optional<Hessian> below;
  constexpr int most_steps = 8;
  for (int i = 0; i < most_steps; ++i) {
    ++approach_.counters.newton_steps;
    const Vec3 place = patch.position(at);
    const Derivatives d = patch.derivatives(at);
    const bool is_nearer = take(place, origin + scale.cwiseProduct(at));
    if (limit() < 0) return true;
    if (i == 0 && distance_along(cell, place) > limit()) return true;
    const double squared = place.squaredNorm();
    if (!below) {
      const SquaredDistance<Bezier> all(cell, place);
      if (is_far(squared + all.least())) return true;
      below = all.below();
    }
    const Eigen::Vector2d gradient(2 * d.du.dot(place), 2 * d.dv.dot(place));
    const bool is_settled = is_far(squared + lowest<D>({at, gradient, *below}).change);
    if (is_settled && !is_nearer) return true;
    const Hessian hessian{2 * (d.du.squaredNorm() + d.duu.dot(place)), 2 * (d.du.dot(d.dv) + d.duv.dot(place)),
                          2 * (d.dv.squaredNorm() + d.dvv.dot(place))};
    const Parameter next = lowest<D>({at, gradient, hessian}).at;
    // The step from the nearest place wins the digits that the proof could do without.
    if (is_settled) take(patch.position(next), origin + scale.cwiseProduct(next));
    if (is_settled || next == at) return is_settled;
    at = next;
  }
  return false;
}

template <class Bezier>
void NearestFinish<Bezier>::split(const Net& cell, const Parameter& origin, const Parameter& scale) {
  const std::array<Bezier, 4> quarters = cell.template bezier<Bezier>().split();
  std::array<Net, 4> children;
  std::array<std::pair<double, int>, 4> order;
  for (std::size_t k = 0; k < 4; ++k) {
    children[k] = Net(quarters[k]);
    order[k] = {hull_distance(children[k]), static_cast<int>(k)};
  }
  std::sort(order.begin(), order.end());
  for (const auto& [distance, k] : order) {
    const Parameter child_origin = origin + scale.cwiseProduct(D::to_parent(k, Parameter::Zero()));
    visit(children[static_cast<std::size_t>(k)], child_origin, scale * D::scale(k));
  }
}

}  // namespace shaolin
