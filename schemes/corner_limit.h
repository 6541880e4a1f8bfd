#pragma once
/// The limit at a patch's corner by masks.
#include <optional>

#include "limit_rows.h"
#include "patch.h"
#include "sharpness.h"

namespace shaolin {

namespace detail {

/// Sums a tangent mask over a ring whose faces are of the scheme's kind.
inline Vec3 tangent(const RingMask& mask, const Ring& ring, const Vec3* points) {
  Vec3 sum = mask.vertex * points[ring.vertex];
  for (std::size_t i = 0; i < mask.edges.size(); ++i) sum += mask.edges[i] * points[ring.spokes[i].end];
  for (std::size_t i = 0; i < mask.diagonals.size(); ++i) sum += mask.diagonals[i] * points[ring.faces[i].vertex(2)];
  return sum;
}

template <Scheme S>
LimitAtCorner smooth_limit(const S& scheme, const Ring& ring, const Vec3* points) {
  const int n = static_cast<int>(ring.spokes.size());
  std::vector<int> ends, diagonals;
  for (const Ring::Spoke& spoke : ring.spokes) ends.push_back(spoke.end);
  const LimitMask mask = scheme.smooth_limit(n);
  Vec3 position = mask.vertex * points[ring.vertex] + mask.edge * symmetric_sum({points, ends.data(), n});
  if (mask.diagonal != 0) {
    for (const FaceSides& face : ring.faces) diagonals.push_back(face.vertex(2));
    position += mask.diagonal * symmetric_sum({points, diagonals.data(), n});
  }
  const Vec3 cosine = tangent(scheme.smooth_tangent(n, 0), ring, points);
  const Vec3 sine = tangent(scheme.smooth_tangent(n, n / 4.0), ring, points);
  return {position, cosine.cross(sine).normalized()};
}

/// The crease is the cubic spline through its vertices; the patch's side leaves it along the cross tangent.
template <Scheme S>
LimitAtCorner crease_limit(const S& scheme, const Ring& ring, const Vec3* points) {
  const auto sharp = [](const Ring::Spoke& spoke) { return is_sharp(spoke.sharpness); };
  const Vec3& a = points[std::find_if(ring.spokes.begin(), ring.spokes.end(), sharp)->end];
  const Vec3& b = points[std::find_if(ring.spokes.rbegin(), ring.spokes.rend(), sharp)->end];
  const CreaseMask crease = crease_of(scheme);
  const Vec3 position = crease.limit_vertex * points[ring.vertex] + crease.limit_edge * (a + b);
  if (ring.closed) return {position, {}};  // a face that repeats its vertex has both sides of the crease in its ring
  const Vec3 across = tangent(scheme.crease_cross_tangent(static_cast<int>(ring.faces.size())), ring, points);
  return {position, (a - b).cross(across).normalized()};
}

/// The limit by splitting towards the corner. Its neighbours come nearer by a factor of at most 0.66 a level
/// (Catmull-Clark at high valence); after 100 levels they are within 1e-18 of their first distance. O(points).
template <Scheme S>
LimitAtCorner limit_by_refinement(Patch<S> patch, int k) {
  constexpr int levels = 100;
  for (int level = 0; level < levels; ++level) patch = patch.child(k);
  return {patch.points[static_cast<std::size_t>(k)], {}};
}

/// The limit by derived masks; empty if there are none yet.
template <Scheme S>
std::optional<LimitAtCorner> derived_limit(const Patch<S>& patch, int k) {
  constexpr std::size_t most_points = 300;  // the masks of so many take some 50 ms, and the cube of that for more
  if (patch.points.size() > most_points) return limit_by_refinement(patch, k);
  const std::optional<LimitRows>& rows = patch.configuration->derived_limit(k);
  if (!rows) return {};
  return rows->at(patch.points);
}

}  // namespace detail

/// The limit at corner k, or empty while sharpness there still decays or faces around are not of the scheme's kind
/// (split first). The normal is empty at a corner vertex of more than one face: its eigenvalues leave no common tangent
/// plane, and each direction into the surface has its own. A dart and a cone have no closed form, their masks are
/// derived (see limit_rows.h): the smooth vertex's (which OpenSubdiv takes) ignore that the sharp edge's own rule
/// changes the subdivision matrix.
template <Scheme S>
std::optional<LimitAtCorner> corner_limit(const Patch<S>& patch, int k) {
  const Neighbourhood& n = patch.configuration->neighbourhood();
  const Ring& ring = n.rings[static_cast<std::size_t>(k)];
  const std::vector<float> sharpness = ring.spoke_sharpness();
  if (is_semi_sharp(ring.sharpness) || std::any_of(sharpness.begin(), sharpness.end(), is_semi_sharp)) return {};
  constexpr int own_size = S::face_kind == FaceKind::triangle ? 3 : 4;
  for (const FaceSides& face : ring.faces)
    if (face.size() != own_size) return {};

  const S& scheme = patch.configuration->scheme();
  const Vec3* points = patch.points.data();
  switch (vertex_rule(ring.sharpness, sharpness)) {
    case VertexRule::smooth:
      if constexpr (ClosedLimits<S>)
        if (has_closed_limits(scheme) && !ring.cone) return detail::smooth_limit(scheme, ring, points);
      return detail::derived_limit(patch, k);
    case VertexRule::dart:
      return detail::derived_limit(patch, k);
    case VertexRule::crease:
      if constexpr (ClosedLimits<S>)
        if (has_closed_limits(scheme)) return detail::crease_limit(scheme, ring, points);
      return detail::derived_limit(patch, k);
    default:
      break;
  }
  LimitAtCorner limit{points[ring.vertex], {}};
  if (!ring.closed && ring.faces.size() == 1) {
    const Vec3 u = points[ring.spokes[0].end] - limit.position, v = points[ring.spokes[1].end] - limit.position;
    limit.normal = u.cross(v).normalized();
  }
  return limit;
}

}  // namespace shaolin
