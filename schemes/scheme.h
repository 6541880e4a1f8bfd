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

/// Weights of a limit tangent by place around a vertex: spoke i, and the diagonal of the face between spokes i and
/// i + 1 (empty for triangles). All weights sum to zero. A left eigenvector of the subdominant eigenvalue.
struct TangentMask {
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

/// A scheme is a small struct, in most cases of constants and static functions; see loop.h and catmull_clark.h.
///
/// - `face_kind`: the split. `radius`: rings of faces around a face that its patch depends on.
/// - `smooth_vertex(n)`, `smooth_edge()`, `smooth_limit(n)`: masks at a smooth interior vertex of valence n, an edge.
/// - `crease`: the weights along a crease. `basis`, `Regular`: the regular patches, and their type in Bezier form.
/// - `smoothness`: what it declares.
/// - `smooth_tangent(n, first)`: the tangent whose weights follow cos(2 pi (i - first) / n). Two of them a quarter
///   turn apart (one by cos, one by sin) span the tangent plane. Empty if the surface has none.
/// - `crease_cross_tangent(k)`: the tangent that leaves a crease into a sector of k faces with spokes 0..k.
/// - `dart_vertex(n)`, if the scheme has one: the vertex mask where one sharp edge ends, else `smooth_vertex(n)`.
/// - `cone_vertex(n)`, if the scheme has one: the vertex mask at a vertex that keeps a tangent cone. It gives the
/// ring's
///   mean mode the eigenvalue of the first Fourier mode, so that height and extent shrink alike.
/// - `triangle_edge(k)`, if the scheme has one: the edge mask beside k triangles (1 or 2) in the quad split's first
///   step, for meshes that ask for smooth triangles.
template <class S>
concept Scheme = requires(const S scheme, int n) {
  { S::face_kind } -> std::convertible_to<FaceKind>;
  { S::radius } -> std::convertible_to<int>;
  { scheme.basis } -> std::convertible_to<Basis>;
  { scheme.crease } -> std::convertible_to<CreaseMask>;
  { scheme.smoothness } -> std::convertible_to<Smoothness>;
  { scheme.smooth_vertex(n) } -> std::same_as<VertexMask>;
  { scheme.smooth_edge() } -> std::same_as<EdgeMask>;
  { scheme.smooth_limit(n) } -> std::same_as<LimitMask>;
  { scheme.smooth_tangent(n, 0.0) } -> std::same_as<TangentMask>;
  { scheme.crease_cross_tangent(n) } -> std::same_as<TangentMask>;
  typename S::Regular;
};

/// A scheme with the options of a mesh: all that decides on refined points beside topology and sharpness.
template <Scheme S>
struct Rules {
  S scheme;
  CreaseMethod creases = CreaseMethod::uniform;
  TriangleSubdivision triangles = TriangleSubdivision::catmark;

  /// The mask of a vertex that goes to the next level by the smooth rule, or the dart's.
  VertexMask vertex(int n, const VertexTransition& to, bool cone) const {
    if constexpr (requires { scheme.dart_vertex(n); })
      if (to.parent == VertexRule::dart || to.child == VertexRule::dart) return scheme.dart_vertex(n);
    if constexpr (requires { scheme.cone_vertex(n); })
      if (cone) return scheme.cone_vertex(n);
    return scheme.smooth_vertex(n);
  }

  /// The mask of a smooth edge between faces of which so many are triangles.
  EdgeMask edge(int triangle_count) const {
    if constexpr (requires { scheme.triangle_edge(1); })
      if (triangles == TriangleSubdivision::smooth && triangle_count > 0) return scheme.triangle_edge(triangle_count);
    return scheme.smooth_edge();
  }
};

}  // namespace shaolin
