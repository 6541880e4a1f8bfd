#pragma once
/// Hulls of border curves: Mueller et al. 2003, section 4.
#include <vector>

#include "../schemes/corner_limit.h"
#include "limit_bounds.h"

namespace shaolin {

/// Which hulls of border curves a tree keeps; stand-ins are those of add_stand_in(), where it has any.
enum class BorderHulls { none, bounds, stand_ins };

namespace detail {

/// The Bezier points of a polynomial's side from corner `edge` to the next.
inline void add_side(const BezierTriangle& piece, int edge, std::vector<Vec3>& points) {
  constexpr int n = BezierTriangle::degree;
  for (int i = 0; i <= n; ++i) {
    const int u = edge == 0 ? i : (edge == 1 ? n - i : 0), v = edge == 0 ? 0 : (edge == 1 ? i : n - i);
    points.push_back(piece.b[BezierTriangle::index(u, v)]);
  }
}
inline void add_side(const BezierQuad& piece, int edge, std::vector<Vec3>& points) {
  constexpr std::array<std::size_t, 4> first{0, 3, 15, 12};
  constexpr std::array<std::ptrdiff_t, 4> step{1, 4, -1, -4};
  const auto side = static_cast<std::size_t>(edge);
  for (std::ptrdiff_t i = 0; i < 4; ++i)
    points.push_back(piece.b[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(first[side]) + i * step[side])]);
}

}  // namespace detail

/// Adds points whose hull holds the limit curve along a patch's edge from corner `edge` to the next. Of a polynomial
/// patch they are the edge's Bezier points (quartic for Loop, as in the paper; cubic for Catmull-Clark). Beside an
/// irregular vertex the patch is split towards it, `halvings` times; all but the last piece are polynomial then, and
/// the bound of its whole limit serves for that one, 2^-halvings as wide as the edge. Where both halves stay irregular
/// (while sharpness decays, and for schemes without polynomials) `splits` of them are the end of it. Shares of the
/// edge, no lengths: instances of all sizes share a tree. O(2^splits halvings).
template <Scheme S>
void add_border_bound(const Patch<S>& patch, int edge, int splits, int halvings, std::vector<Vec3>& points) {
  if (patch.is_regular()) return detail::add_side(patch.regular(), edge, points);
  const int next = (edge + 1) % static_cast<int>(Domain<S::face_kind>::corner_count);
  if (splits == 0 || halvings == 0) {
    if (patch.configuration->hull_expansion() == 0) {
      points.insert(points.end(), patch.points.begin(), patch.points.end());
      return;
    }
    const Box box = limit_bound(patch);
    for (const double x : {box.lower.x(), box.upper.x()})
      for (const double y : {box.lower.y(), box.upper.y()})
        for (const double z : {box.lower.z(), box.upper.z()}) points.emplace_back(x, y, z);
    return;
  }
  const Patch<S> first = patch.child(edge), second = patch.child(next);
  const bool both = !first.is_regular() && !second.is_regular();
  add_border_bound(first, edge, splits - both, halvings - 1, points);
  add_border_bound(second, edge, splits - both, halvings - 1, points);
}

namespace detail {

/// The derivative, at corner k, of the limit curve along the edge to `end`, by the paper's rules for its stand-in:
/// (6 / n) sum cos(2 pi i / n) cp_i / 3 at a smooth vertex of Loop's scheme, and what becomes of it for other tangent
/// masks by holding the regular case to the polynomial (Catmull-Clark: the B-spline's derivative is a twelfth of the
/// mask); half the distance of both neighbours on a crease; the edge itself at a corner. Empty elsewhere.
template <ClosedLimits S>
std::optional<Vec3> border_derivative(const Patch<S>& patch, int k, int end) {
  const S& scheme = patch.configuration->scheme();
  const Ring& ring = patch.configuration->neighbourhood().rings[static_cast<std::size_t>(k)];
  const Vec3* points = patch.points.data();
  const auto is_edge = [&](const Ring::Spoke& spoke) { return spoke.end == end; };
  const auto spoke = std::find_if(ring.spokes.begin(), ring.spokes.end(), is_edge);
  if (spoke == ring.spokes.end()) return {};
  const int n = static_cast<int>(ring.spokes.size());
  switch (vertex_rule(ring.sharpness, ring.spoke_sharpness())) {
    case VertexRule::smooth: {
      constexpr bool triangles = S::face_kind == FaceKind::triangle;
      const double share = triangles ? 2.0 / n : 1.0 / (3 * n);
      const RingMask mask = scheme.smooth_tangent(n, static_cast<double>(spoke - ring.spokes.begin()));
      return Vec3(share * tangent(mask, ring, points));
    }
    case VertexRule::crease: {
      if (!is_sharp(spoke->sharpness)) return {};
      for (const Ring::Spoke& other : ring.spokes)
        if (is_sharp(other.sharpness) && &other != &*spoke) return Vec3(0.5 * (points[end] - points[other.end]));
      return {};
    }
    case VertexRule::corner:
      return Vec3(points[end] - points[ring.vertex]);
    default:
      return {};
  }
}

}  // namespace detail

/// The paper's stand-in c(t) for the border curve beside irregular vertices: the quartic with the curve's ends,
/// derivatives there, and middle (section 4; digest: c1 = c0 + c'(0) / 4, c2 = 8/3 (c(1/2) - c0/16 - c1/4 - c3/4 -
/// c4/16)). Its hull is no bound of the curve. Adds five points and returns true, or returns false where the paper has
/// no rule: sharpness that decays, darts, schemes without closed limit masks.
template <Scheme S>
bool add_stand_in(const Patch<S>& patch, int edge, std::vector<Vec3>& points) {
  if constexpr (ClosedLimits<S>) {
    constexpr int corners = Domain<S::face_kind>::corner_count;
    const int next = (edge + 1) % corners;
    if (!has_closed_limits(patch.configuration->scheme())) return false;
    const auto from = corner_limit(patch, edge), to = corner_limit(patch, next);
    const auto middle = corner_limit(patch.child(edge), next);
    if (!from || !to || !middle) return false;
    const auto leaving = detail::border_derivative(patch, edge, next),
               coming = detail::border_derivative(patch, next, edge);
    if (!leaving || !coming) return false;
    const Vec3 &c0 = from->position, &c4 = to->position;
    const Vec3 c1 = c0 + *leaving / 4, c3 = c4 + *coming / 4;
    const Vec3 c2 = 8.0 / 3 * (middle->position - c0 / 16 - c1 / 4 - c3 / 4 - c4 / 16);
    points.insert(points.end(), {c0, c1, c2, c3, c4});
    return true;
  } else {
    return false;
  }
}

}  // namespace shaolin
