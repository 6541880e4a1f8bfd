#pragma once
/// How far a limit patch may leave the convex hull of its control points.
#include <algorithm>
#include <cmath>

#include "neighbourhood.h"
#include "scheme.h"

namespace shaolin {

/// True if the masks of vertices with 3 up to so many neighbours, of edges and of creases are convex combinations: no
/// weight is negative, and they sum to one. (Masks that do not sum to one leave every hull, and every bound that counts
/// on one.) Masks of radius 2 are taken to be none: which are asked for depends on pairs of vertices.
template <Scheme S>
bool has_convex_masks(const Rules<S>& rules, int most_neighbours) {
  if (rules.radius() == 2) return false;
  const auto is_one = [](double sum) { return std::abs(sum - 1) <= 1e-12; };
  const CreaseMask crease = rules.crease();
  if (crease.vertex < 0 || crease.edge < 0 || !is_one(crease.vertex + 2 * crease.edge)) return false;
  for (const int triangles : {0, 1, 2}) {
    const EdgeMask edge = rules.edge(triangles);
    if (edge.end < 0 || edge.side < 0 || !is_one(2 * (edge.end + edge.side))) return false;
  }
  for (int n = 3; n <= most_neighbours; ++n)
    for (const VertexMask& mask :
         {rules.scheme.smooth_vertex(n), dart_vertex_of(rules.scheme, n), cone_vertex_of(rules.scheme, n)}) {
      if (mask.vertex < 0 || mask.edge < 0 || mask.face < 0) return false;
      if (!is_one(mask.vertex + n * (mask.edge + mask.face))) return false;
    }
  return true;
}

/// The share of the hull's extent along an axis by which the patch may pass the hull on either side; `sharpest` is the
/// largest semi-sharp value among the edges around.
///
/// All masks are convex combinations but one: under Chaikin's rule an edge of sharpness s in (1, 4/3) may lose one of
/// its halves in this step, and then its point is s midpoint + (1 - s) smooth (see edge_crease_share). That is
/// (s - 1) (midpoint - smooth) beyond the midpoint, where midpoint - smooth = side ((a + b) - (left + right)): less
/// than 2/3 side of the extent. From 4/3 on both halves stay sharp, for 3/4 s - 1 >= 0; and values lose 1 a step. So it
/// can happen in the next ceil(sharpest) - 1 steps, and each widens what the next starts from by 4/3 side.
template <Scheme S>
double hull_expansion(const Rules<S>& rules, float sharpest) {
  if (rules.creases == CreaseMethod::uniform || sharpest <= 1) return 0;
  const double side = std::max({rules.edge(0).side, rules.edge(1).side, rules.edge(2).side});
  const double steps = std::ceil(static_cast<double>(sharpest)) - 1;
  return 0.5 * (std::pow(1 + 4 * side / 3, steps) - 1) * (1 + 1e-12);
}

/// The same for a patch of that neighbourhood.
template <Scheme S>
double hull_expansion(const Rules<S>& rules, const Neighbourhood& neighbourhood) {
  float sharpest = 0;
  for (const Ring& ring : neighbourhood.rings)
    for (const Ring::Spoke& spoke : ring.spokes)
      if (is_semi_sharp(spoke.sharpness)) sharpest = std::max(sharpest, spoke.sharpness);
  return hull_expansion(rules, sharpest);
}

}  // namespace shaolin
