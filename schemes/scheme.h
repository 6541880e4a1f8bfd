#pragma once
/// What a subdivision scheme has to say: masks, by valence. It knows no topology; the sharpness rules know no scheme.
#include <concepts>
#include <vector>

#include "control_mesh.h"
#include "sharpness.h"

namespace shaolin {

/// The two splits: a triangle into four triangles, a face into one quad per corner.
enum class FaceKind { triangle, quad };

/// Weights of a new vertex point: the vertex itself, each of its n neighbours along edges, and each of the n new face
/// points around it (quad split only). vertex + n (edge + face) = 1.
struct VertexMask {
  double vertex, edge, face;
};

/// Weights of a new edge point: each end, and each side's new face point (quad split) or opposite vertex (triangles).
/// 2 (end + side) = 1.
struct EdgeMask {
  double end, side;
};

/// Weights of a vertex's limit position: the vertex, each neighbour along edges, and each vertex diagonally across a
/// quad. vertex + n (edge + diagonal) = 1. It is the left eigenvector of eigenvalue 1.
struct LimitMask {
  double vertex, edge, diagonal;
};

/// Weights over a ring, by place: the vertex, spoke i, and the diagonal vertex of the face between spokes i and i + 1
/// (empty for triangles). Spokes count counter-clockwise from a place that the mask's maker names.
struct RingMask {
  double vertex = 0;
  std::vector<double> edges, diagonals;
};

/// The weights on a crease, of a vertex and of each of its two neighbours along the crease, in a new vertex point and
/// in the limit. A new edge point is the midpoint, whatever the scheme.
struct CreaseMask {
  double vertex, edge;
  double limit_vertex, limit_edge;
};

/// The uniform cubic B-spline curve, the same for every smooth scheme, so that a crease is one curve seen from both its
/// sides. Edge (1/2, 1/2), vertex (1/8, 3/4, 1/8), whose limit is (1/6, 2/3, 1/6); not the tempting (1/5, 3/5, 1/5),
/// which belongs to another edge rule (3/8, 5/8).
inline constexpr CreaseMask cubic_crease{3.0 / 4, 1.0 / 8, 2.0 / 3, 1.0 / 6};

/// The polygon: vertices stay.
inline constexpr CreaseMask linear_crease{1, 0, 1, 0};

/// The polynomials that a regular patch consists of.
enum class Basis {
  none,    ///< none are known: the surface is found by refinement alone
  spline,  ///< bicubic B-spline on quads, quartic box spline on triangles
  linear   ///< bilinear on quads, linear on triangles; every quad and every triangle is regular
};

/// How smooth a scheme declares its surfaces to be at a vertex of each kind: 0 continuous, 1 with tangent planes. The
/// conformance kit holds the scheme to it.
struct Smoothness {
  int smooth, dart, crease, corner;
  /// At a smooth vertex the ring's mean mode has the square of the tangents' eigenvalue, as curvature has: what Loop
  /// chose his vertex weights for.
  bool square_mean_mode = false;
};
inline constexpr Smoothness smooth_surface{1, 1, 1, 0};
inline constexpr Smoothness continuous_surface{0, 0, 0, 0};

/// New edge points from the ends and what lies beside them: radius 1.
template <class S>
concept EdgeMasks = requires(const S scheme) {
  { scheme.smooth_edge() } -> std::same_as<EdgeMask>;
};

/// New edge points from the rings of both ends: radius 2.
template <class S>
concept RingMasks = requires(const S scheme, int n) {
  { scheme.edge_end(n, n) } -> std::same_as<RingMask>;
};

/// A scheme is a small struct, in most cases of constants and static functions: its refinement masks. See loop.h for
/// one of radius 1 and docs/examples/ for those of radius 2.
///
/// - `face_kind`: the split.
/// - `smooth_vertex(n)`: the mask at a smooth interior vertex of valence n.
/// - `smooth_edge()`, or else `edge_end(n, other)`: the smooth edge point. `edge_end` is what the end of valence n
///   gives if the other end has valence `other`, counted from the edge itself; the point is the sum over both ends.
///   Vertex masks are asked for n >= 2, `edge_end` for n, other >= 3 (an edge beside a vertex of valence 2 is cut in
///   its middle). Where a ring ends at a crease or a boundary it is continued by mirror images (see closed_ring.h): a
///   crease of k faces counts as valence 2 k.
///
/// All else is optional:
///
/// - `face_corner(n)` (quads, with `edge_end`): what the corner of valence n gives to the new point of a quad, counted
///   from the quad's side that leaves the corner; the quad's own diagonal is diagonal 0. Default: the mean of corners.
/// - `crease`: the weights along a crease; default cubic_crease. `smoothness`: what it declares; default smooth.
/// - `dart_vertex(n)`: the vertex mask where one sharp edge ends, `cone_vertex(n)`: at a vertex that keeps a tangent
///   cone; default smooth_vertex(n). (A cone's mask gives the ring's mean mode the eigenvalue of the first Fourier
///   mode, so that height and extent shrink alike.)
/// - `triangle_edge(k)`: the edge mask beside k triangles (1 or 2) in the quad split's first step, for meshes that ask
///   for smooth triangles.
/// - `basis`: what regular patches are made of. With Basis::none (the default) points are found by local refinement.
/// - closed forms of limit masks, together: `smooth_limit(n)`; `smooth_tangent(n, first)`, the tangent whose weights
///   follow cos(2 pi (i - first) / n), two of which a quarter turn apart span the tangent plane (empty if the surface
///   has none); `crease_cross_tangent(k)`, the tangent that leaves a crease into a sector of k faces with spokes 0..k.
///   Without them, limit masks are derived from the subdivision matrix (see limit_rows.h).
template <class S>
concept Scheme = (EdgeMasks<S> || RingMasks<S>)&&requires(const S scheme, int n) {
  { S::face_kind } -> std::convertible_to<FaceKind>;
  { scheme.smooth_vertex(n) } -> std::same_as<VertexMask>;
};

template <class S>
concept ClosedLimits = requires(const S scheme, int n) {
  { scheme.smooth_limit(n) } -> std::same_as<LimitMask>;
  { scheme.smooth_tangent(n, 0.0) } -> std::same_as<RingMask>;
  { scheme.crease_cross_tangent(n) } -> std::same_as<RingMask>;
};

/// Rings of faces around a face that its patch depends on. (A scheme that has both kinds of edge masks says which.)
template <Scheme S>
int radius_of(const S& scheme) {
  if constexpr (requires { scheme.radius; }) return scheme.radius;
  return RingMasks<S> ? 2 : 1;
}

template <Scheme S>
Basis basis_of(const S& scheme) {
  if constexpr (requires { scheme.basis; }) return scheme.basis;
  return Basis::none;
}

template <Scheme S>
CreaseMask crease_of(const S& scheme) {
  if constexpr (requires { scheme.crease; }) return scheme.crease;
  return cubic_crease;
}

template <Scheme S>
Smoothness smoothness_of(const S& scheme) {
  if constexpr (requires { scheme.smoothness; }) return scheme.smoothness;
  return smooth_surface;
}

template <Scheme S>
bool has_closed_limits(const S& scheme) {
  if constexpr (requires { scheme.closed_limits; }) return scheme.closed_limits;
  return ClosedLimits<S>;
}

template <Scheme S>
VertexMask dart_vertex_of(const S& scheme, int n) {
  if constexpr (requires { scheme.dart_vertex(n); }) return scheme.dart_vertex(n);
  return scheme.smooth_vertex(n);
}

template <Scheme S>
VertexMask cone_vertex_of(const S& scheme, int n) {
  if constexpr (requires { scheme.cone_vertex(n); }) return scheme.cone_vertex(n);
  return scheme.smooth_vertex(n);
}

/// A quarter of the corner itself: the point of the quad is the mean of its corners.
inline RingMask quarter_of_corner(int n) {
  const std::vector<double> zeros(static_cast<std::size_t>(n), 0);
  return {0.25, zeros, zeros};
}

template <Scheme S>
RingMask face_corner_of(const S& scheme, int n) {
  if constexpr (requires { scheme.face_corner(n); }) return scheme.face_corner(n);
  return quarter_of_corner(n);
}

/// A scheme with the options of a mesh: all that decides on refined points beside topology and sharpness.
template <Scheme S>
struct Rules {
  S scheme;
  CreaseMethod creases = CreaseMethod::uniform;
  TriangleSubdivision triangles = TriangleSubdivision::catmark;

  /// 2 if edge and face points come from rings.
  int radius() const { return radius_of(scheme); }
  CreaseMask crease() const { return crease_of(scheme); }

  /// The mask of a vertex that goes to the next level by the smooth rule, or the dart's. No scheme is asked for it
  /// where neither rule of the transition has a use for it: a corner may have any number of neighbours.
  VertexMask vertex(int n, const VertexTransition& to, bool cone) const {
    if (!is_smooth_rule(to.parent) && !is_smooth_rule(to.child)) return {};
    if (to.parent == VertexRule::dart || to.child == VertexRule::dart) return dart_vertex_of(scheme, n);
    return cone ? cone_vertex_of(scheme, n) : scheme.smooth_vertex(n);
  }

  /// The mask of a smooth edge between faces of which so many are triangles. Radius 1.
  EdgeMask edge(int triangle_count) const {
    if constexpr (requires { scheme.triangle_edge(1); })
      if (triangles == TriangleSubdivision::smooth && triangle_count > 0) return scheme.triangle_edge(triangle_count);
    if constexpr (EdgeMasks<S>) return scheme.smooth_edge();
    return {};
  }

  /// Radius 2.
  RingMask edge_end(int n, int other) const {
    if constexpr (RingMasks<S>) return scheme.edge_end(n, other);
    return {};
  }
  RingMask face_corner(int n) const { return face_corner_of(scheme, n); }
};

}  // namespace shaolin
