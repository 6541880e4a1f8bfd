#pragma once
/// Kobbelt's interpolating scheme on quads ("Interpolatory subdivision on open quadrilateral nets with arbitrary
/// topology", 1996): the four-point rule (-1 9 9 -1) / 16 along both directions.
#include <shaolin/schemes/plugin.h>

struct Kobbelt {
  static constexpr const char* name = "kobbelt";
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::quad;
  /// Tangent planes at smooth vertices is what the author shows.
  static constexpr shaolin::Smoothness smoothness{1, 0, 0, 0};
  static constexpr double inner = 9.0 / 16, outer = -1.0 / 16;

  static shaolin::VertexMask smooth_vertex(int) { return {1, 0, 0}; }

  /// The four-point rule's half: the vertex, and what continues the edge (spoke 0) behind it.
  static shaolin::RingMask edge_end(int n, int) {
    shaolin::RingMask mask{inner, zeros(n), zeros(n)};
    add_virtual_point(mask, n, 0, outer);
    return mask;
  }

  /// The four-point rule once more, across a row of edge points. In the direction of spoke 0 the corner gives its half
  /// of the edge point on spoke 0, and of the one on the edge from spoke -1 to diagonal -1, which diagonal -2
  /// continues. The other direction is the mirror image; both give the same, so this is their mean for symmetry only.
  static shaolin::RingMask face_corner(int n) {
    shaolin::RingMask mask{inner * inner, zeros(n), zeros(n)};
    for (const int side : {0, 1}) {
      add_virtual_point(mask, n, side, inner * outer / 2);
      at(mask.edges, side == 0 ? -1 : 2) += outer * inner / 2;
      at(mask.diagonals, side == 0 ? -2 : 2) += outer * outer / 2;
    }
    return mask;
  }

 private:
  /// The point behind the vertex as seen from spoke i: 4 mean(l) - (l_-1 + l_0 + l_1) + c (h_-2 + h_-1 + h_0 + h_1 - 4
  /// mean(h)), spokes l and diagonals h counted from i. At valence 4 it is the opposite spoke. Kobbelt's condition that
  /// face points be the same along both directions asks for c = -outer / inner: only h_-2 and h_2 of two neighbouring
  /// spokes do not cancel, with the weight outer (outer + c inner).
  static void add_virtual_point(shaolin::RingMask& mask, int n, int i, double weight) {
    const double c = -outer / inner;
    for (double& spoke : mask.edges) spoke += weight * 4 / n;
    for (double& diagonal : mask.diagonals) diagonal -= weight * c * 4 / n;
    for (int j = -1; j <= 1; ++j) at(mask.edges, i + j) -= weight;
    for (int j = -2; j <= 1; ++j) at(mask.diagonals, i + j) += weight * c;
  }

  static std::vector<double> zeros(int n) { return std::vector<double>(static_cast<std::size_t>(n), 0); }

  /// Around the ring.
  static double& at(std::vector<double>& ring, int i) {
    const int n = static_cast<int>(ring.size());
    return ring[static_cast<std::size_t>((i + n) % n)];
  }
};

SHAOLIN_SCHEME_PLUGIN(Kobbelt)
