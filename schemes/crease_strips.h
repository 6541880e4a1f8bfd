#pragma once
/// The limit beside a semi-sharp crease, in closed form: polynomials in strips along the crease.
#include <array>
#include <optional>
#include <vector>

#include "regular_layout.h"

namespace shaolin {

/// A face of Catmull-Clark's scheme all of whose corners are regular, and whose only sharp edges are one of its sides
/// and this side's continuations at both ends, all of one sharpness s under uniform decay.
///
/// Refinement is then a tensor product. Along the crease every rule is the cubic B-spline's: the crease's own masks,
/// (1/8, 3/4, 1/8) and (1/2, 1/2), are the smooth ones of a line of points. Across it a line of points p0, p1 (on the
/// crease), p2, p3 is refined by the spline's rules, too, but p1 stays for s levels: with half of a level's interval
/// behind it the farther half has smooth ends, so that it is a polynomial; the nearer half is the same thing again, of
/// sharpness s - 1. So ceil(s) splits leave ceil(s) + 1 bicubic strips, where quartering makes 2^s pieces. (Niessner et
/// al., Efficient evaluation of semi-smooth creases, 2012, have the same strips for integers; a fraction f of a level
/// blends the rule at p1, f of it staying, as in schemes/sharpness.h.)
class CreaseStrips {
 public:
  /// A part of the patch, and what makes its Bezier points of the grid.
  struct Strip {
    SubDomain domain;
    BezierQuad::Maps maps;
  };

  /// Nearest to the crease last; ceil(s) + 1 of them.
  const std::vector<Strip>& strips() const { return strips_; }

  /// The 4 x 4 points that all strips of a patch with these control points are made of, in rows along u.
  std::array<Vec3, 16> grid(const Vec3* points) const;

 private:
  friend std::optional<CreaseStrips> crease_strips(const Neighbourhood&);

  CreaseStrips(int side, float sharpness, std::vector<SplinePoint> grid);
  void add(int side, double from, double to, const Eigen::Matrix4d& line);

  std::vector<SplinePoint> grid_;
  std::vector<Strip> strips_;
};

/// Empty for any other face. Takes the neighbourhood as regular_layout(); its creases must decay uniformly.
std::optional<CreaseStrips> crease_strips(const Neighbourhood& neighbourhood);

}  // namespace shaolin
