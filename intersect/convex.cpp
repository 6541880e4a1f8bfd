#include "convex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shaolin {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The corner is nearest, or what is between two of them.
Convex::Nearest nearest_of_segment(const Vec3& a, const Vec3& b, const Vec3& point) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0;
  if (t <= 0) return {a, 3};
  if (t >= 1) return {b, 3};
  Convex::Nearest nearest{a + t * along, 2};
  const Vec3 first = along.unitOrthogonal();
  nearest.normals.col(0) = first;
  nearest.normals.col(1) = along.cross(first).normalized();
  return nearest;
}

}  // namespace

QueryFrame::QueryFrame(const Box& shape, const Box& scene) : centre(shape.centre()) {
  Box all = shape;
  all.add(scene);
  // (Halves, for the whole may leave the range of numbers.)
  const double size = (0.5 * all.upper - 0.5 * all.lower).cwiseAbs().maxCoeff();
  constexpr int largest = 1000;
  if (size > 0 && std::isfinite(size)) scale = std::scalbn(1.0, std::clamp(-std::ilogb(size) - 1, -largest, largest));
}

Simplex::Simplex(std::vector<Vec3> corners, double radius) : Convex(radius), corners_(std::move(corners)) {
  if (corners_.size() < 3) return;
  const Vec3 ab = corners_[1] - corners_[0], ac = corners_[2] - corners_[0], normal = ab.cross(ac);
  // With an angle of less than 2^-40 at its corner rounding alone may have given the triangle its normal; it is as
  // narrow as that, and a segment for all purposes.
  if (normal.norm() > 0x1p-40 * ab.norm() * ac.norm()) sides_ = {normal.normalized(), -normal.normalized()};
}

auto Simplex::nearest(const Vec3& point) const -> Nearest {
  if (corners_.size() == 1) return {corners_[0], 3};
  if (corners_.size() == 2) return nearest_of_segment(corners_[0], corners_[1], point);
  const std::array<Vec3, 3> corners{corners_[0], corners_[1], corners_[2]};
  bool is_over = !sides_.empty();
  for (std::size_t i = 0; i < 3 && is_over; ++i)
    is_over = (corners[(i + 1) % 3] - corners[i]).cross(point - corners[i]).dot(sides_[0]) >= 0;
  if (is_over) {
    Nearest nearest{point - (point - corners[0]).dot(sides_[0]) * sides_[0], 1};
    nearest.normals.col(0) = sides_[0];
    return nearest;
  }
  std::optional<Nearest> best;
  for (std::size_t i = 0; i < 3; ++i) {
    const Nearest one = nearest_of_segment(corners[i], corners[(i + 1) % 3], point);
    if (!best || (one.point - point).squaredNorm() < (best->point - point).squaredNorm()) best = one;
  }
  return *best;
}

double Simplex::support(const Vec3& n) const {
  double most = -infinity;
  for (const Vec3& corner : corners_) most = std::max(most, n.dot(corner));
  return most;
}

auto Simplex::flat() const -> std::optional<Flat> {
  Flat flat{Eigen::Matrix3d::Identity(), corners_[0]};
  if (corners_.size() == 1) return flat;
  if (corners_.size() == 2) {
    const Vec3 along = (corners_[1] - corners_[0]).normalized();  // zero for two that are one point
    flat.across -= along * along.transpose();
    return flat;
  }
  if (sides_.empty()) return {};
  flat.across = sides_[0] * sides_[0].transpose();
  return flat;
}

Block::Block(const Vec3& centre, const Eigen::Matrix3d& axes, const Vec3& half)
    : Convex(0), centre_(centre), axes_(axes), half_(half) {
  for (Eigen::Index i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) sides_.emplace_back(sign * axes.col(i));
}

auto Block::nearest(const Vec3& point) const -> Nearest {
  const Vec3 local = axes_.transpose() * (point - centre_);
  Nearest nearest{point};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double beyond = local[i] - std::clamp(local[i], -half_[i], half_[i]);
    if (beyond == 0) continue;
    nearest.point -= beyond * axes_.col(i);
    nearest.normals.col(nearest.rank++) = axes_.col(i);
  }
  return nearest;
}

double Block::support(const Vec3& n) const { return n.dot(centre_) + half_.dot((axes_.transpose() * n).cwiseAbs()); }

/// Corners are where three sides meet. Each that is in all half-spaces, up to what its solution is good to, counts.
Polytope::Polytope(std::vector<HalfSpace> half_spaces) : Convex(0), half_spaces_(std::move(half_spaces)) {
  for (const HalfSpace& side : half_spaces_) sides_.push_back(side.normal);
  const std::size_t count = half_spaces_.size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k) {
        Eigen::Matrix3d rows;
        rows << sides_[i].transpose(), sides_[j].transpose(), sides_[k].transpose();
        const double determinant = rows.determinant();
        if (std::abs(determinant) < 0x1p-40) continue;
        const Vec3 corner =
            rows.inverse() * Vec3(half_spaces_[i].offset, half_spaces_[j].offset, half_spaces_[k].offset);
        if (holds(corner)) corners_.push_back(corner);
      }
}

/// In a frame whose lengths are about 1.
bool Polytope::holds(const Vec3& point) const {
  return std::all_of(half_spaces_.begin(), half_spaces_.end(), [&](const HalfSpace& side) {
    return side.normal.dot(point) - side.offset <= 64 * unit_roundoff * (1 + point.norm());
  });
}

/// The nearest point lies on one side, two or three; it is the one of these projections that is in all half-spaces and
/// that is left along the sides' normals only.
auto Polytope::nearest(const Vec3& point) const -> Nearest {
  if (holds(point)) return {point};
  Nearest best{corners_.front(), 3};
  double least = infinity;
  const std::size_t count = half_spaces_.size();
  const auto take = [&](const std::array<std::size_t, 3>& on, int rank) {
    Eigen::Matrix<double, 3, Eigen::Dynamic> normals(3, rank);
    Eigen::VectorXd beyond(rank);
    for (int i = 0; i < rank; ++i) {
      const HalfSpace& side = half_spaces_[on[static_cast<std::size_t>(i)]];
      normals.col(i) = side.normal;
      beyond[i] = side.normal.dot(point) - side.offset;
    }
    const Eigen::MatrixXd gram = normals.transpose() * normals;
    if (rank > 1 && std::abs(gram.determinant()) < 0x1p-40) return;
    const Vec3 there = point - normals * (gram.inverse() * beyond);
    const double distance = (there - point).norm();
    if (!(distance < least) || !holds(there)) return;
    least = distance;
    best = {there, rank};
    best.normals.leftCols(rank) = Eigen::MatrixXd(normals.householderQr().householderQ()).leftCols(rank);
  };
  // The distance is the least one over all ways to be on sides, for each of these points is in the polytope.
  for (std::size_t i = 0; i < count; ++i) take({i}, 1);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) take({i, j}, 2);
  for (const Vec3& corner : corners_)
    if (const double distance = (corner - point).norm(); distance < least) {
      least = distance;
      best = {corner, 3};
    }
  return best;
}

double Polytope::support(const Vec3& n) const {
  double most = -infinity;
  for (const Vec3& corner : corners_) most = std::max(most, n.dot(corner));
  return most;
}

}  // namespace shaolin
