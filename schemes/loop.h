#pragma once
/// Loop's scheme on triangles (C. Loop, "Smooth subdivision surfaces based on triangles", 1987), with his weights at
/// irregular vertices and with Warren's.
#include <cmath>
#include <numbers>

#include "crease_tangent.h"
#include "scheme.h"

namespace shaolin {

/// The masks of Loop's scheme for a choice of `Weights::neighbour_weight(n)`, the share of each neighbour in a vertex
/// point; at valence 6 it must be 1/16.
template <class Weights>
struct LoopMasks {
  static constexpr FaceKind face_kind = FaceKind::triangle;
  static constexpr int regular_valence = 6;
  static constexpr Basis basis = Basis::spline;
  static constexpr CreaseMask crease = cubic_crease;
  static constexpr Smoothness smoothness = smooth_surface;

  static VertexMask smooth_vertex(int n) {
    if (n == regular_valence) return {5.0 / 8, 1.0 / 16, 0};
    const double beta = Weights::neighbour_weight(n);
    return {1 - n * beta, beta, 0};
  }

  /// The mean mode's eigenvalue is 5/8 - n beta; with beta = (1 - cos(2 pi / n)) / (4 n) that is the first Fourier
  /// mode's, 3/8 + cos(2 pi / n) / 4.
  static VertexMask cone_vertex(int n) {
    const double share = 0.25 * (1 - std::cos(2 * std::numbers::pi / n));
    return {1 - share, share / n, 0};
  }

  static EdgeMask smooth_edge() { return {3.0 / 8, 1.0 / 8}; }

  /// The left eigenvector of eigenvalue 1 of (vertex, ring mean): 1 / (n + 3 / (8 beta)) a neighbour.
  static LimitMask smooth_limit(int n) {
    if (n == regular_valence) return {0.5, 1.0 / 12, 0};
    const double edge = 1 / (n + 3 / (8 * Weights::neighbour_weight(n)));
    return {1 - n * edge, edge, 0};
  }

  /// Loop 1987: cos(2 pi i / n), here from a place `first`, measured in spokes.
  static RingMask smooth_tangent(int n, double first) {
    RingMask mask;
    for (int i = 0; i < n; ++i) mask.edges.push_back(std::cos(2 * std::numbers::pi * (i - first) / n));
    return mask;
  }

  /// Interior spokes i = 1..k-1 weigh sin(i pi / k), the odd Fourier mode of the doubled sector, of eigenvalue
  /// 3/8 + cos(pi / k) / 4; k = 3 is the regular crease, eigenvalue 1/2.
  static RingMask crease_cross_tangent(int k) {
    if (k == 1) return single_face_crease_tangent();
    const double theta = std::numbers::pi / k;
    RingMask mask;
    mask.edges.assign(static_cast<std::size_t>(k) + 1, 0);
    double sum = 0;
    for (int i = 1; i < k; ++i) sum += mask.edges[static_cast<std::size_t>(i)] = std::sin(i * theta);
    complete_crease_tangent(mask, 3.0 / 8 + std::cos(theta) / 4, mask.edges[1] / 8, 3.0 / 8 * sum);
    return mask;
  }
};

struct Loop : LoopMasks<Loop> {
  static constexpr const char* name = "loop";
  static constexpr Smoothness smoothness{1, 1, 1, 0, true};

  /// (5/8 - (3/8 + cos(2 pi / n) / 4)^2) / n. The square is not optional: without it the weight at valence 3 is 0.201
  /// instead of 3/16.
  static double neighbour_weight(int n) {
    const double centre = 3.0 / 8 + std::cos(2 * std::numbers::pi / n) / 4;
    return (5.0 / 8 - centre * centre) / n;
  }
};

/// The simpler weights of J. Warren ("Subdivision methods for geometric design", 1995): tangents as with Loop's, for
/// the ring's Fourier modes do not see the vertex.
struct Warren : LoopMasks<Warren> {
  static constexpr const char* name = "warren";

  static double neighbour_weight(int n) { return n == 3 ? 3.0 / 16 : 3.0 / (8.0 * n); }
};

static_assert(Scheme<Loop> && Scheme<Warren>);

}  // namespace shaolin
