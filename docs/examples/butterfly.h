#pragma once
/// The modified butterfly scheme (Zorin, Schroeder and Sweldens, "Interpolating subdivision for meshes with arbitrary
/// topology", 1996): triangles, vertices stay, and an edge point is read from the rings of the edge's ends.
#include <shaolin/schemes/plugin.h>

#include <cmath>
#include <numbers>

struct Butterfly {
  static constexpr const char* name = "butterfly";
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::triangle;
  /// Tangent planes at smooth vertices is what the authors prove.
  static constexpr shaolin::Smoothness smoothness{1, 0, 0, 0};

  static shaolin::VertexMask smooth_vertex(int) { return {1, 0, 0}; }

  /// Spoke 0 is the edge itself. Between regular ends each gives half of the butterfly of eight points: 1/2 of itself,
  /// half of the 1/8 of the two vertices beside the edge, which both ends have, and -1/16 of its two wings. An
  /// irregular end decides alone against a regular one, and by half against another irregular one.
  static shaolin::RingMask edge_end(int n, int other) {
    shaolin::RingMask mask{0, std::vector<double>(static_cast<std::size_t>(n), 0), {}};
    if (n != 6) {
      const double share = other == 6 ? 1 : 0.5;
      mask.vertex = share * 3 / 4;
      for (int j = 0; j < n; ++j) mask.edges[static_cast<std::size_t>(j)] = share * irregular(n, j);
    } else if (other == 6) {
      mask = {0.5, {0, 1.0 / 16, -1.0 / 16, 0, -1.0 / 16, 1.0 / 16}, {}};
    }
    return mask;
  }

 private:
  static double irregular(int n, int j) {
    if (n == 3) return j == 0 ? 5.0 / 12 : -1.0 / 12;
    if (n == 4) return j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0;
    const double angle = 2 * std::numbers::pi * j / n;
    return (0.25 + std::cos(angle) + 0.5 * std::cos(2 * angle)) / n;
  }
};

SHAOLIN_SCHEME_PLUGIN(Butterfly)
