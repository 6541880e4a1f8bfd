#pragma once
/// Wrong on purpose: Loop's scheme with two slips that published code has made. `shaolin scheme check` names both.
#include <shaolin/schemes/plugin.h>

#include <cmath>
#include <numbers>

struct Toy {
  static constexpr const char* name = "toy";
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::triangle;
  static constexpr shaolin::Basis basis = shaolin::Basis::spline;
  static constexpr shaolin::Smoothness smoothness{1, 1, 1, 0, true};

  /// First slip: the vertex keeps the share that it has at valence 6, so that the weights do not sum to one elsewhere.
  static shaolin::VertexMask smooth_vertex(int n) { return {5.0 / 8, neighbour_weight(n), 0}; }

  static shaolin::EdgeMask smooth_edge() { return {3.0 / 8, 1.0 / 8}; }

 private:
  /// Second slip: Loop squares (3 + 2 cos(2 pi / n)) / 8; here stands its root over 64, which is 0.201 at valence 3
  /// instead of 3/16.
  static double neighbour_weight(int n) {
    return (5.0 / 8 - std::sqrt(3 + 2 * std::cos(2 * std::numbers::pi / n)) / 64) / n;
  }
};

SHAOLIN_SCHEME_PLUGIN(Toy)
