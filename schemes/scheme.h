#pragma once
/// What a subdivision scheme has to say: masks, by valence. It knows no topology; the sharpness rules know no scheme.
#include <concepts>
#include <vector>

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

/// The rules on a crease: those of a uniform cubic B-spline curve, whatever the scheme, so that a crease is the same
/// curve seen from both its sides. Edge (1/2, 1/2), vertex (1/8, 3/4, 1/8), whose limit is (1/6, 2/3, 1/6); not the
/// tempting (1/5, 3/5, 1/5), which belongs to another edge rule (3/8, 5/8).
struct CubicCrease {
  static constexpr double vertex = 3.0 / 4.0;
  static constexpr double edge = 1.0 / 8.0;
  static constexpr double limit_vertex = 2.0 / 3.0;
  static constexpr double limit_edge = 1.0 / 6.0;
};

/// A scheme is a struct of constants and static functions; see loop.h and catmull_clark.h.
///
/// - `face_kind`: the split. `radius`: rings of faces around a face that its patch depends on.
/// - `regular_valence`: of an interior vertex of a regular patch.
/// - `smooth_vertex(n)`, `smooth_edge()`, `smooth_limit(n)`: masks at a smooth interior vertex of valence n, an edge.
/// - `smooth_tangent(n, first)`: the tangent whose weights follow cos(2 pi (i - first) / n). Two of them a quarter
///   turn apart (one by cos, one by sin) span the tangent plane: `smooth_tangents(n)` returns both.
/// - `crease_cross_tangent(k)`: the tangent that leaves a crease into a sector of k faces with spokes 0..k.
/// - `Regular`: the patch type in Bezier form with the map from a regular neighbourhood.
template <class S>
concept Scheme = requires(int n) {
  { S::name } -> std::convertible_to<const char*>;
  { S::face_kind } -> std::convertible_to<FaceKind>;
  { S::radius } -> std::convertible_to<int>;
  { S::regular_valence } -> std::convertible_to<int>;
  { S::smooth_vertex(n) } -> std::same_as<VertexMask>;
  { S::smooth_edge() } -> std::same_as<EdgeMask>;
  { S::smooth_limit(n) } -> std::same_as<LimitMask>;
  { S::smooth_tangent(n, 0.0) } -> std::same_as<TangentMask>;
  { S::crease_cross_tangent(n) } -> std::same_as<TangentMask>;
  typename S::Regular;
};

}  // namespace shaolin
