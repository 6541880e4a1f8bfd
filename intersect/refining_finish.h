#pragma once
/// The finish for surfaces without polynomials: the first point of a patch on a ray, by local refinement.
#include "counters.h"
#include "limit_bounds.h"
#include "newton_finish.h"

namespace shaolin {

/// Finds the nearest zero of (x, y) with z in [near, far] on a patch whose points are given in a ray's frame.
///
/// A cell is dropped only on proof: the bound of its limit (limit_bounds.h) lies to one side of the ray, beyond the
/// nearest hit, or where its flat part meets the ray, with all that the remainder can add, no parameter of the cell is.
/// Where the neighbourhood is a lattice's, the remainder falls with the square of a cell's size: one child a split is
/// left, and after half as many splits as a double has bits the cell is its flat part to within rounding, which gives
/// parameter and distance. Nothing is kept between rays.
template <Scheme S>
class RefiningFinish {
 public:
  /// As NewtonFinish.
  RefiningFinish(double error, double near, double far, bool far_is_hit, RayCounters& counters)
      : error_(error), near_(near), has_hit_(far_is_hit), counters_(counters) {
    best_.distance = far;
  }

  /// True if a hit was found; then hit() is the nearest.
  bool solve(const Patch<S>& projected) {
    const Box bound = limit_bound(projected);
    grain_ = 0x1p-42 * (bound.upper - bound.lower).maxCoeff();
    visit(projected, Parameter::Zero(), 1);
    return found_;
  }
  const PatchHit& hit() const { return best_; }

  /// As NewtonFinish.
  void solve(const Patch<S>& projected, std::vector<PatchHit>& hits) {
    all_ = &hits;
    solve(projected);
  }

 private:
  using D = Domain<S::face_kind>;

  /// As in NewtonFinish: where a ray runs along the surface, cells become points sooner after this many.
  static constexpr int patience = 512;

  /// A cell's parameters p stand for origin + scale * p.
  void visit(const Patch<S>& cell, const Parameter& origin, double scale);
  bool is_outside(const Box& box) const {
    return box.lower.x() > error_ || box.upper.x() < -error_ || box.lower.y() > error_ || box.upper.y() < -error_ ||
           box.upper.z() < near_ - error_ || box.lower.z() > horizon();
  }
  bool is_point(const Box& box) const {
    const double across = std::max(box.upper.head<2>().maxCoeff(), -box.lower.head<2>().minCoeff());
    return across <= 2 * error_ && box.upper.z() - box.lower.z() <= 16 * error_;
  }
  /// Halving further gives no other parameters. Near the corner (0, 0) there is no end to halving, and there must not
  /// be: around an irregular vertex a cell shrinks by the subdominant eigenvalue, which for many faces is well above
  /// 1/2.
  static bool is_one_parameter(const Parameter& origin, double scale) {
    return origin + Parameter::Constant(0.5 * scale) == origin;
  }
  static Parameter nearest_in_space(const Eigen::Matrix2d& jacobian, const Eigen::Vector2d& origin);
  void accept(const PatchHit& hit, const Parameter& origin, double scale);
  double horizon() const {
    return best_.distance + (has_hit_ ? -std::exp2(std::min(4, cells_ / patience)) * error_ : error_);
  }

  double error_;
  double near_;
  double grain_ = 0;  ///< the size of a point for a finish out of patience: 2^-42 of the patch
  bool has_hit_;
  RayCounters& counters_;
  PatchHit best_;
  std::vector<PatchHit>* all_ = nullptr;
  bool found_ = false;
  int cells_ = 0;
};

template <Scheme S>
void RefiningFinish<S>::accept(const PatchHit& hit, const Parameter& origin, double scale) {
  if (hit.distance < near_ - error_ || hit.distance > horizon()) return;
  const PatchHit own{origin + scale * hit.at, std::max(hit.distance, near_), hit.reach, hit.is_proven, hit.radius};
  if (all_) return all_->push_back(own);
  best_ = own;
  found_ = has_hit_ = true;
}

/// The parameter on the domain's sides at which |origin + jacobian p| is least. (Least in p would not do: where a ray
/// grazes the surface, a small step in one parameter alone leads far away from it.)
template <Scheme S>
Parameter RefiningFinish<S>::nearest_in_space(const Eigen::Matrix2d& jacobian, const Eigen::Vector2d& origin) {
  Parameter nearest = Parameter::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < D::corner_count; ++i) {
    const auto& corner = D::corners[i];
    const auto& next = D::corners[(i + 1) % D::corner_count];
    const Parameter from(corner[0], corner[1]), along(next[0] - corner[0], next[1] - corner[1]);
    const Eigen::Vector2d start = origin + jacobian * from, step = jacobian * along;
    const Parameter at = from + std::clamp(-start.dot(step) / step.squaredNorm(), 0.0, 1.0) * along;
    const double distance = (origin + jacobian * at).norm();
    if (distance < least) least = distance, nearest = at;
  }
  return nearest;
}

template <Scheme S>
void RefiningFinish<S>::visit(const Patch<S>& cell, const Parameter& origin, double scale) {
  ++counters_.cells;
  ++cells_;
  const Box bound = limit_bound(cell);
  if (is_outside(bound)) return;
  const double grain = all_ ? std::ldexp(grain_, 6 * std::ilogb(std::max(1, cells_ / patience))) : grain_;
  const bool is_grain = cells_ > patience && (bound.upper - bound.lower).maxCoeff() <= grain;
  if (is_point(bound) || is_grain || is_one_parameter(origin, scale))
    return accept({D::centre(), cell.points.front().z(), bound.upper.z() - bound.lower.z()}, origin, scale);

  // Parameters at which the flat part may lie on the ray; all, if it stands edge-on to the ray.
  Parameter low(0, 0), high(1, 1);
  if (const std::optional<FlatPart> part = flat_part(cell)) {
    Eigen::Matrix2d jacobian;
    jacobian << part->along_u.x(), part->along_v.x(), part->along_u.y(), part->along_v.y();
    if (std::abs(jacobian.determinant()) > 1e-12 * jacobian.col(0).norm() * jacobian.col(1).norm()) {
      const Eigen::Matrix2d inverse = jacobian.inverse();
      const Box& rest = part->remainder;
      const Eigen::Vector2d half = 0.5 * (rest.upper - rest.lower).head<2>();
      const Eigen::Vector2d middle = part->corner.head<2>() + 0.5 * (rest.upper + rest.lower).head<2>();
      const Parameter centre = -(inverse * middle);
      const Parameter reach = inverse.cwiseAbs() * (half.array() + error_).matrix() * (1 + 1e-10);
      low = centre - reach;
      high = centre + reach;
      if (low.x() > 1 || low.y() > 1 || high.x() < 0 || high.y() < 0) return;
      if (half.maxCoeff() <= 0.5 * error_ && rest.upper.z() - rest.lower.z() <= error_) {
        const Parameter at = D::contains(centre) ? centre : nearest_in_space(jacobian, middle);
        // A point of the ray's band may be as far off as the remainder on top; beyond, the ray passes the cell by.
        if ((jacobian * at + middle).cwiseAbs().maxCoeff() > 2 * error_) return;
        const double distance = part->at(at).z() + 0.5 * (rest.lower.z() + rest.upper.z());
        return accept({at, distance, 0, true}, origin, scale);
      }
    }
  }

  struct Child {
    double distance;
    int k;
    Patch<S> patch;
  };
  std::vector<Child> children;
  for (int k = 0; k < 4; ++k) {
    const Parameter a = D::to_parent(k, Parameter::Zero()), b = D::to_parent(k, Parameter::Ones());
    if (((a.cwiseMin(b) - high).array() > 0).any() || ((low - a.cwiseMax(b)).array() > 0).any()) continue;
    Child child{0, k, cell.child(k)};
    for (const Vec3& point : child.patch.points) child.distance += point.z();
    child.distance /= static_cast<double>(child.patch.points.size());
    children.push_back(std::move(child));
  }
  std::sort(children.begin(), children.end(),
            [](const Child& a, const Child& b) { return std::tie(a.distance, a.k) < std::tie(b.distance, b.k); });
  for (const Child& child : children)
    visit(child.patch, origin + scale * D::to_parent(child.k, Parameter::Zero()), scale * D::scale(child.k));
}

}  // namespace shaolin
