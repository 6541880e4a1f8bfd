#pragma once
/// Hits and their certificates, decided anew in numbers of 113 bits.
#include <span>
#include <vector>

#include "tools/validate/check_rays.h"
#include "tools/validate/quad_oracle.h"

namespace shaolin {

/// What came of the hits, lengths in diagonals.
struct ExactHitFigures {
  std::size_t rays = 0, hits = 0, certified = 0;
  double worst_position = 0;  ///< of certified hits: from the position to the exact crossing
  double worst_ulps = 0;      ///< the same in units of the last place of the largest coordinate of position and origin
  double worst_bound_share = 0;  ///< the same over the certificate's error: above 1 the bound is wrong
  double worst_residual = 0;     ///< of the others: from the exact surface at the hit's parameters to the exact ray
  std::vector<Disagreement> disagreements;
};

/// Traces the rays one after the other and derives each hit again from the exact input: control points and ray as the
/// doubles that they are, the surface refined by the masks alone (QuadOracle) at the hit's parameters and beside them,
/// and one Newton step of the three equations S(u, v) = origin + t direction from there, which leaves the square of a
/// step of some roundings.
///
/// A certified hit must have the exact crossing within its certificate's error, and within its face, or beyond a side
/// where the surface goes on smoothly. Any other hit must lie on the surface and the ray to within bar::on_surface and
/// bar::on_ray. Some 100 ms a certified hit.
ExactHitFigures check_exact_hits(const Intersector& ours, const ControlMesh& mesh, const QuadOracle& oracle,
                                 std::span<const ProbeRay> rays);

}  // namespace shaolin
