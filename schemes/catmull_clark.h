#pragma once
/// Catmull and Clark's scheme on quads and n-gons (CAD 10(6), 1978).
#include <cmath>
#include <numbers>

#include "crease_tangent.h"
#include "scheme.h"

namespace shaolin {

struct CatmullClark {
  static constexpr const char* name = "catmark";
  static constexpr FaceKind face_kind = FaceKind::quad;
  static constexpr int regular_valence = 4;
  static constexpr Basis basis = Basis::spline;
  static constexpr CreaseMask crease = cubic_crease;
  static constexpr Smoothness smoothness = smooth_surface;

  /// ((n - 2) vertex + mean of neighbours + mean of new face points) / n.
  static VertexMask smooth_vertex(int n) {
    const double weight = 1.0 / (static_cast<double>(n) * n);
    return {static_cast<double>(n - 2) / n, weight, weight};
  }

  /// With t for all neighbours together and t for all new face points, the means of spokes and diagonals, relative to
  /// the vertex, go through ((1 - 3 t, 1/4 - t / 2), (1 - 3 t, 1/2 - t / 2)) / 2, of which lambda is an eigenvalue for
  ///     t = (3/4 lambda - lambda^2 - 1/16) / (7/4 lambda - 3/16).
  /// lambda is the first Fourier mode's. t lies between 0 and 0.15.
  static VertexMask cone_vertex(int n) {
    const double lambda = subdominant(2 * std::numbers::pi / n);
    const double t = (0.75 * lambda - lambda * lambda - 1.0 / 16) / (1.75 * lambda - 3.0 / 16);
    return {1 - 2 * t, t / n, t / n};
  }

  /// The mean of both ends and both new face points, not of the face points alone.
  static EdgeMask smooth_edge() { return {0.25, 0.25}; }

  /// OpenSubdiv's option for smoother triangles: the new face points weigh 0.47 on a triangle's side in place of 1/4,
  /// both sides the mean of their two weights.
  static EdgeMask triangle_edge(int triangles) {
    const double side = triangles == 2 ? 0.47 : 0.5 * (0.47 + 0.25);
    return {0.5 * (1 - 2 * side), side};
  }

  /// Halstead, Kass and DeRose 1993: (n^2, 4, 1) / (n (n + 5)). It holds at valence 2 as well, where OpenSubdiv takes
  /// the vertex itself, which is not the limit.
  static LimitMask smooth_limit(int n) {
    const double diagonal = 1.0 / (static_cast<double>(n) * (n + 5));
    return {static_cast<double>(n) / (n + 5), 4 * diagonal, diagonal};
  }

  /// Halstead, Kass and DeRose 1993: A cos(2 pi i / n) a spoke, cos(2 pi i / n) + cos(2 pi (i + 1) / n) a diagonal.
  static RingMask smooth_tangent(int n, double first) {
    const double step = 2 * std::numbers::pi / n;
    return fourier_tangent(n, n, step, [=](int i) { return std::cos(step * (i - first)); });
  }

  /// The odd Fourier mode of the doubled sector, sin(i pi / k), with the same A; k = 2 is the regular crease. The masks
  /// that Biermann, Levin and Zorin 2000 print belong to their modified rules, whose eigenvalue is 1/2 for every k.
  static RingMask crease_cross_tangent(int k) {
    if (k == 1) return single_face_crease_tangent();
    const double theta = std::numbers::pi / k;
    RingMask mask = fourier_tangent(k, k + 1, theta, [=](int i) { return i % k == 0 ? 0 : std::sin(i * theta); });
    double edges = 0, diagonals = 0;
    for (const double weight : mask.edges) edges += weight;
    for (const double weight : mask.diagonals) diagonals += weight;
    complete_crease_tangent(mask, subdominant(theta), mask.edges[1] / 16 + mask.diagonals[0] / 4,
                            3.0 / 8 * edges + diagonals / 4);
    return mask;
  }

 private:
  /// The eigenvalue of the Fourier mode exp(i theta) of spokes and diagonals.
  static double subdominant(double theta) {
    const double c = std::cos(theta);
    return (5 + c + std::sqrt((9 + c) * (1 + c))) / 16;
  }

  template <class Mode>
  static RingMask fourier_tangent(int faces, int spokes, double step, Mode mode) {
    const double c = std::cos(step);
    const double spoke = 1 + c + std::cos(step / 2) * std::sqrt(2 * (9 + c));
    RingMask mask;
    for (int i = 0; i < spokes; ++i) mask.edges.push_back(spoke * mode(i));
    for (int i = 0; i < faces; ++i) mask.diagonals.push_back(mode(i) + mode(i + 1));
    return mask;
  }
};

static_assert(Scheme<CatmullClark>);

}  // namespace shaolin
