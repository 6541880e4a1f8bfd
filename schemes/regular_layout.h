#pragma once
/// Finding the spline control points of a regular patch in its neighbourhood.
#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <vector>

#include "bezier_quad.h"
#include "bezier_triangle.h"
#include "neighbourhood.h"
#include "scheme.h"

namespace shaolin {

/// The polynomial patches of each split.
template <FaceKind kind>
using RegularPatch = std::conditional_t<kind == FaceKind::triangle, BezierTriangle, BezierQuad>;

/// A spline control point as a small combination of the neighbourhood's points: one of them, or a phantom beyond a
/// crease, so placed that the spline's smooth rules give the crease rules:
/// on quads 2 p0 - p1 (p0 on the crease, p1 inside), and twice that at a corner; on triangles a + b - c, the vertex
/// opposite of c across the sharp edge a-b, and 2 c - a, 2 c - b behind a corner c. (Substitute them into the smooth
/// masks: (1/8, 3/4, 1/8) comes out along a crease, c at a corner.)
struct SplinePoint {
  int count = 0;
  std::array<int, 4> index{};
  std::array<double, 4> weight{};

  Vec3 of(const Vec3* points) const {
    if (count == 1) return points[index[0]];
    Vec3 sum = weight[0] * points[index[0]];
    for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) sum += weight[i] * points[index[i]];
    return sum;
  }
};

/// Where the points stand that a regular patch is made from, and how.
template <class Bezier>
struct RegularLayout {
  std::vector<SplinePoint> points;
  Basis basis;  ///< not `none`

  /// True if the spline reaches beyond all sides and has a point of the surface at each place: then the polynomials
  /// there continue this one as smoothly as the spline. (No phantoms; linear patches reach nowhere.)
  bool is_smooth_across() const {
    return points.size() == Bezier::spline_size &&
           std::all_of(points.begin(), points.end(), [](const SplinePoint& point) { return point.count == 1; });
  }

  /// The first points.size() are set.
  std::array<Vec3, Bezier::spline_size> spline(const Vec3* control) const {
    std::array<Vec3, Bezier::spline_size> spline;
    for (std::size_t i = 0; i < points.size(); ++i) spline[i] = points[i].of(control);
    return spline;
  }

  Bezier patch(const Vec3* control) const {
    return basis == Basis::linear ? Bezier::from_corners(spline(control)) : Bezier::from_spline(spline(control));
  }
};

/// The layout as a matrix: Bezier points = matrix * control points.
template <class Bezier>
Eigen::MatrixXd bezier_matrix(const RegularLayout<Bezier>& layout, int points) {
  Eigen::MatrixXd matrix(Bezier::size, points);
  std::vector<Vec3> unit(static_cast<std::size_t>(points), Vec3::Zero());
  for (int i = 0; i < points; ++i) {
    unit[static_cast<std::size_t>(i)].x() = 1;
    const Bezier column = layout.patch(unit.data());
    for (int row = 0; row < Bezier::size; ++row) matrix(row, i) = column.b[static_cast<std::size_t>(row)].x();
    unit[static_cast<std::size_t>(i)].x() = 0;
  }
  return matrix;
}

/// The 4 x 4 control points of a face's bicubic patch, in rows along u. Each corner's ring must be closed and of four
/// quads, or open and regular.
std::vector<SplinePoint> bicubic_grid(const Neighbourhood& neighbourhood);

/// The layout of a regular patch; empty if the neighbourhood is irregular or no basis is known. Linear: any face of the
/// scheme's own kind. Spline: every corner must be smooth and of regular valence, or lie on an infinitely sharp crease
/// (a boundary) with half as many faces on this side, or be an infinitely sharp corner of a single face. Takes the
/// neighbourhood as canonical_form() has it: cut at creases, rings turned to the face.
template <class Bezier>
std::optional<RegularLayout<Bezier>> regular_layout(Basis basis, const Neighbourhood& neighbourhood);

template <>
std::optional<RegularLayout<BezierQuad>> regular_layout(Basis, const Neighbourhood&);
template <>
std::optional<RegularLayout<BezierTriangle>> regular_layout(Basis, const Neighbourhood&);

}  // namespace shaolin
