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
  struct Strip {
    SubDomain domain;
    BezierQuad polynomial;
  };

  /// How many there are: ceil(s) + 1.
  std::size_t count() const { return across_.size(); }

  /// The strips of a patch with these control points, nearest to the crease last. O(s).
  std::vector<Strip> strips(const Vec3* points) const;

 private:
  friend std::optional<CreaseStrips> crease_strips(const Neighbourhood&);
  using LineMap = Eigen::Matrix4d;

  /// At these distances from the crease, with its line of spline points = map * (p0, p1, p2, p3).
  struct Across {
    double from, to;
    LineMap map;
  };

  CreaseStrips(int side, float sharpness, std::vector<SplinePoint> grid);

  int side_;  ///< of the face: from corner `side_` to the next
  std::vector<SplinePoint> grid_;
  std::vector<Across> across_;
};

/// Empty for any other face. Takes the neighbourhood as regular_layout(); its creases must decay uniformly.
std::optional<CreaseStrips> crease_strips(const Neighbourhood& neighbourhood);

}  // namespace shaolin
