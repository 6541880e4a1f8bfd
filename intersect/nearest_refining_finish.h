#pragma once
/// The nearest point of a patch without polynomials, by local refinement.
#include <algorithm>
#include <tuple>

#include "limit_bounds.h"
#include "point_approach.h"
#include "quadratic.h"

namespace shaolin {

/// Looks for a nearer place than the approach knows on a patch whose points are relative to the query's.
///
/// A cell is dropped on proof only. Where the neighbourhood is a lattice's, the surface is its flat part
/// (limit_bounds.h) and a remainder that falls with the square of a cell's size: the flat part's nearest point to the
/// origin, give or take the remainder, bounds the distance from both sides. Elsewhere the box of the limit does. A
/// cell's nearest place is known once both bounds agree to within the error. Nothing is kept between queries.
template <Scheme S>
class NearestRefiningFinish {
 public:
  /// As NearestFinish.
  NearestRefiningFinish(double error, PointApproach& approach) : error_(error), approach_(approach) {}

  bool solve(const Patch<S>& relative) {
    visit(relative, Parameter::Zero(), 1);
    return found_;
  }
  const Parameter& at() const { return at_; }

 private:
  using D = Domain<S::face_kind>;

  /// As in NearestFinish.
  static constexpr int patience = 2048;

  /// What is known of a cell: the least that a distance can be, and a place with its parameter, good to within a
  /// length.
  struct Bounds {
    double least;
    Vec3 place;
    Parameter at;
    double reach;
  };
  static Bounds bounds(const Patch<S>& cell);

  /// A cell's parameters p stand for origin + scale * p.
  void visit(const Patch<S>& cell, const Parameter& origin, double scale);
  double limit() const { return approach_.limit(error_ * std::exp2(std::min(5, cells_ / patience))); }

  double error_;
  PointApproach& approach_;
  bool found_ = false;
  Parameter at_ = Parameter::Zero();
  int cells_ = 0;
};

template <Scheme S>
auto NearestRefiningFinish<S>::bounds(const Patch<S>& cell) -> Bounds {
  if (const std::optional<FlatPart> part = flat_part(cell)) {
    const Vec3 middle = part->remainder.centre();
    const double reach = 0.5 * (part->remainder.upper - part->remainder.lower).norm();
    const Vec3 start = part->at(D::centre()) + middle;
    const Vec3 &u = part->along_u, &v = part->along_v;
    const Hessian hessian{u.squaredNorm(), u.dot(v), v.squaredNorm()};
    const Parameter at = lowest<D>({D::centre(), {u.dot(start), v.dot(start)}, hessian}).at;
    const Vec3 place = part->at(at) + middle;
    return {place.norm() - reach, place, at, reach};
  }
  const Box box = hull_bound(cell);
  const Vec3 outside = box.lower.cwiseMax(-box.upper).cwiseMax(0.0);
  return {outside.norm(), box.centre(), D::centre(), 0.5 * (box.upper - box.lower).norm()};
}

template <Scheme S>
void NearestRefiningFinish<S>::visit(const Patch<S>& cell, const Parameter& origin, double scale) {
  ++approach_.counters.cells;
  ++cells_;
  const Bounds known = bounds(cell);
  if (known.least > limit()) return;
  // Half of it may be what the two bounds disagree by.
  const bool is_point = origin + Parameter::Constant(0.5 * scale) == origin;
  if (2 * known.reach <= error_ || is_point) {
    if (approach_.take(known.place, error_)) {
      at_ = origin + scale * known.at;
      found_ = true;
    }
    return;
  }
  struct Child {
    double least;
    int k;
    Patch<S> patch;
  };
  std::vector<Child> children;
  for (Patch<S>& child : cell.children()) {
    const double least = bounds(child).least;
    children.push_back({least, static_cast<int>(children.size()), std::move(child)});
  }
  std::sort(children.begin(), children.end(),
            [](const Child& a, const Child& b) { return std::tie(a.least, a.k) < std::tie(b.least, b.k); });
  for (const Child& child : children)
    if (child.least <= limit())
      visit(child.patch, origin + scale * D::to_parent(child.k, Parameter::Zero()), scale * D::scale(child.k));
}

}  // namespace shaolin
