#pragma once
/// An object's cells in the frame of a query.
#include "convex.h"
#include "placement.h"
#include "surface_cell.h"

namespace shaolin {

/// A place of a cell in a query's frame, with derivatives there.
struct FramedSample {
  CellSample own;  ///< in the object's space
  Vec3 position;
  std::optional<Derivatives> derivatives;
};

/// The map from an object's space to a query's frame.
class CellFrame {
 public:
  /// `bounds` holds the object, in its own space; `shape` the size of the shape in the frame.
  CellFrame(const QueryFrame& frame, const Placement& placement, const Box& bounds, double shape)
      : linear_(frame.scale * placement.to_world().linear()),
        offset_(frame.scale * (placement.to_world().translation() - frame.centre)) {
    const Vec3 largest = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs());
    constexpr double share = 64 * unit_roundoff;
    error_ = share * ((linear_.cwiseAbs() * largest + offset_.cwiseAbs()).maxCoeff() + shape);
    // In the frame, sides of boxes of the object's space have the normals n with n . (linear x) = x_i.
    const Eigen::Matrix3d inverse = linear_.inverse();
    for (Eigen::Index i = 0; i < 3; ++i) sides_[static_cast<std::size_t>(i)] = inverse.row(i).transpose().normalized();
  }

  Vec3 operator()(const Vec3& point) const { return linear_ * point + offset_; }

  /// The point of a convex set around a cell that is least along n, up to error(), as SurfaceCell::supporting_point().
  Vec3 supporting_point(const SurfaceCell& cell, const Vec3& n) const {
    return (*this)(cell.supporting_point(linear_.transpose() * n));
  }
  /// A lower bound of n . x over a cell, up to error().
  double low(const SurfaceCell& cell, const Vec3& n) const { return n.dot(supporting_point(cell, n)); }
  /// A lower bound of |map x| over a cell relative to a point, as SurfaceCell::least_length().
  double least_length(const SurfaceCell& cell, const Eigen::Matrix3d& map, const Vec3& point,
                      const Parameter& at) const {
    return cell.least_length(map * linear_, map * (offset_ - point), at);
  }
  std::optional<FramedSample> sample(const SurfaceCell& cell, const Parameter& at) const {
    const std::optional<CellSample> own = cell.sample(at);
    if (!own) return {};
    FramedSample sample{*own, (*this)(own->position), own->derivatives};
    if (sample.derivatives)
      for (Vec3 Derivatives::*one :
           {&Derivatives::du, &Derivatives::dv, &Derivatives::duu, &Derivatives::duv, &Derivatives::dvv})
        (*sample.derivatives).*one = linear_ * ((*sample.derivatives).*one);
    return sample;
  }

  /// The largest extent of a cell, at most.
  double extent(const SurfaceCell& cell) const {
    return (linear_.cwiseAbs() * (cell.box().upper - cell.box().lower)).maxCoeff();
  }
  /// The normals of the sides of cells' boxes, unit.
  const std::array<Vec3, 3>& sides() const { return sides_; }

  /// The uncertainty of a distance between a cell's place, or a plane that bounds the cell, and the shape. With u =
  /// 2^-53, a point of a polynomial is a mean of up to 16 points with weights good to 3 u, in 6 sums: 10 u a
  /// coordinate; the control points that came out of up to some 20 levels of means carry as much again, the map's sum
  /// of four terms 4 u, the shape's nearest point 8 u, and 18 u in all that is taken for a length: below 64 u of the
  /// largest magnitudes.
  double error() const { return error_; }

 private:
  Eigen::Matrix3d linear_;
  Vec3 offset_;
  double error_;
  std::array<Vec3, 3> sides_;
};

}  // namespace shaolin
