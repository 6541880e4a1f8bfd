#pragma once
/// Completing the cross tangent of a crease from its interior weights.
#include <cassert>

#include "scheme.h"

namespace shaolin {

/// Sets the weights of the two crease spokes (equal, by symmetry) and of the vertex in a left eigenvector of eigenvalue
/// `lambda`. `into_end` and `into_vertex` are what the interior rows contribute to those two columns. The curve's own
/// rows give, for end weight a and vertex weight v,
///     (1/2 - lambda) a + 1/8 v = -into_end,     a + (3/4 - lambda) v = -into_vertex,
/// whose determinant is (lambda - 1)(lambda - 1/4): regular for every subdominant lambda.
inline void complete_crease_tangent(RingMask& mask, double lambda, double into_end, double into_vertex) {
  const double determinant = (lambda - 1) * (lambda - 0.25);
  assert(determinant != 0);
  const double end = (-into_end * (0.75 - lambda) + into_vertex * 0.125) / determinant;
  mask.vertex = (-into_vertex * (0.5 - lambda) + into_end) / determinant;
  mask.edges.front() = end;
  mask.edges.back() = end;
}

/// The sector of one face: along the crease 1/2, across only 1/4, shared with the curve's second difference in a Jordan
/// block that the latter dominates. So the surface leaves the crease towards the middle of its two edges.
inline RingMask single_face_crease_tangent() { return {-2, {1, 1}, {}}; }

}  // namespace shaolin
