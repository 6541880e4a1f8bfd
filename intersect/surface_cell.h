#pragma once
/// The pieces of a limit surface as searches with shapes see them, whatever the scheme.
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "../schemes/domain.h"
#include "../schemes/limit_sample.h"
#include "box.h"

namespace shaolin {

/// A place of a cell: its position, and derivatives per unit of the cell's own parameters; none where it is a corner
/// that the surface is not smooth at, or where there are no polynomials.
struct CellSample {
  Parameter at;  ///< in the cell
  Vec3 position;
  std::optional<Derivatives> derivatives;
};

/// Part of a patch's domain: its parameters p are the domain's at origin + axes * p. Exact, as SubDomain, for entries
/// are differences of parameters that halving makes.
struct CellDomain {
  Parameter origin = Parameter::Zero();
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();

  CellDomain() = default;
  CellDomain(const SubDomain& part) : origin(part.origin), axes(part.scale.asDiagonal()) {}
  CellDomain(const Parameter& from, const Parameter& to_u, const Parameter& to_v) : origin(from) {
    axes << to_u - from, to_v - from;
  }

  Parameter operator()(const Parameter& at) const { return origin + axes * at; }
  /// A part of this part.
  CellDomain operator()(const CellDomain& part) const {
    CellDomain result;
    result.origin = (*this)(part.origin);
    result.axes = axes * part.axes;
    return result;
  }
  /// Halvings along the coordinate that was halved most often.
  int depth() const { return -std::ilogb(axes.cwiseAbs().rowwise().maxCoeff().minCoeff()); }
};

/// A part of an object's surface, in the object's space: a node of the hierarchy over its faces, a face, a patch, or a
/// piece of one. A cell is known by bounds; once it is a patch, by samples, too; and by the smaller cells that it
/// consists of, made when they are first asked for. Of one query: not thread-safe.
class SurfaceCell {
 public:
  /// Where in the surface a cell lies.
  struct Place {
    int face = -1;  ///< -1 for a node of the hierarchy, which may hold several
    int sub = 0;
    CellDomain domain;    ///< of the face's
    int level = 0;        ///< of refinement
    double rounding = 0;  ///< what positions and bounds are good to
  };

  SurfaceCell(const Box& box, const Place& place) : box_(box), place_(place) {}
  virtual ~SurfaceCell() = default;
  SurfaceCell(const SurfaceCell&) = delete;
  SurfaceCell& operator=(const SurfaceCell&) = delete;

  const Box& box() const { return box_; }
  const Place& place() const { return place_; }

  /// The point of a convex set around the cell that is least along n, up to the cell's rounding. For a patch the set is
  /// the box or part of it; for an n across the surface its point falls short of the cell's by no more than the square
  /// of the cell's size.
  virtual Vec3 supporting_point(const Vec3& n) const { return (n.array() > 0).select(box_.lower, box_.upper); }

  /// A lower bound of |map x + offset| over the cell of a patch, up to rounding: that of a function of second degree
  /// which touches the square at a place of the cell and is nowhere above it. Tight if the length is least there. 0
  /// where nothing is known.
  virtual double least_length(const Eigen::Matrix3d&, const Vec3&, const Parameter&) const { return 0; }

  /// The place of the cell at a parameter of its domain, or, where only one is at hand, that one; empty for cells that
  /// are known by bounds alone.
  virtual std::optional<CellSample> sample(const Parameter&) const { return {}; }

  /// What the cell consists of. Never empty for a cell that is larger than rounding.
  const std::vector<std::unique_ptr<SurfaceCell>>& parts() {
    if (!is_split_) parts_ = split();
    is_split_ = true;
    return parts_;
  }

  /// True if the domain of a patch is a triangle.
  virtual bool is_triangular() const { return false; }

  SurfaceParameter parameter(const Parameter& at) const {
    const Parameter in_face = place_.domain(at);
    const Parameter inside =
        is_triangular() ? Domain<FaceKind::triangle>::nearest(in_face) : Domain<FaceKind::quad>::nearest(in_face);
    return {place_.face, place_.sub, inside.x(), inside.y()};
  }

 protected:
  using Cells = std::vector<std::unique_ptr<SurfaceCell>>;
  virtual Cells split() const = 0;

 private:
  Box box_;
  Place place_;
  Cells parts_;
  bool is_split_ = false;
};

}  // namespace shaolin
