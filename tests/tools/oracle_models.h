#pragma once
// Small meshes with every kind of feature, and random places on them, for the tests of the oracle and the dense check.
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/models.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin::oracle_test {

/// A body or a sheet for each feature, without symmetry: a wrong weight must not cancel. Semi-sharp tags stay below the
/// levels that brute force refines.
inline std::vector<Model> feature_models() {
  std::vector<Model> all;
  for (const std::string scheme : {"catmark", "loop"}) {
    const bool loop = scheme == "loop";
    const auto add = [&](const std::string& name, ControlMesh mesh) {
      all.push_back({scheme + " " + name, scheme, shaken(std::move(mesh), 0.13)});
    };
    const ControlMesh body = loop ? poles(scheme, 5) : cube();
    const std::pair<int, int> e1 = loop ? std::pair(0, 2) : std::pair(0, 1),
                              e2 = loop ? std::pair(2, 3) : std::pair(1, 2),
                              e3 = loop ? std::pair(0, 4) : std::pair(1, 5);
    add("smooth", body);
    add("tetrahedron", tetrahedron());
    add("dart", with_edges(body, {{e1.first, e1.second, 10}}));
    add("crease", with_edges(body, {{e1.first, e1.second, 10}, {e2.first, e2.second, 10}}));
    add("corner", with_edges(body, {{e1.first, e1.second, 10}, {e2.first, e2.second, 10}, {e3.first, e3.second, 10}}));
    add("semi-sharp",
        with_edges(body, {{e1.first, e1.second, 2.5f}, {e2.first, e2.second, 1.2f}, {e3.first, e3.second, 10}}));
    add("Chaikin",
        with_edges(body, {{e1.first, e1.second, 2.5f}, {e2.first, e2.second, 1.2f}, {e3.first, e3.second, 3}},
                   CreaseMethod::chaikin));
    ControlMesh vertices = body;
    vertices.sharp_vertices = {{0, 10}, {1, 2.3f}, {3, 0.4f}};
    add("sharp vertices", vertices);
    add("edge only", with_boundary(sheet(scheme, 2, 3), BoundaryInterpolation::edge_only));
    add("edge and corner", sheet(scheme, 2, 3));
    ControlMesh chain = sheet(scheme, 4, 4);
    chain.sharp_edges = {{10, 11, 5}, {11, 12, 1}, {12, 13, 1.5f}, {7, 12, 3}, {12, 17, 0.5f}};
    chain.crease_method = CreaseMethod::chaikin;
    add("Chaikin, uneven", chain);
    add("no boundary", with_boundary(sheet(scheme, 4, 4), BoundaryInterpolation::none));
    if (loop) continue;
    add("prism", with_edges(prism(5), {{0, 1, 10}, {1, 3, 1.7f}}));
    ControlMesh smooth_triangles = poles("loop", 5);
    smooth_triangles.triangle_subdivision = TriangleSubdivision::smooth;
    add("smooth triangles", smooth_triangles);
    add("valence 2", valence_two());
  }
  return all;
}

inline SurfaceParameter random_parameter(const Oracle& oracle, std::mt19937& random) {
  SurfaceParameter at;
  std::uniform_real_distribution<double> unit(0, 1);
  do {
    at.face = std::uniform_int_distribution<int>(0, oracle.face_count() - 1)(random);
  } while (!oracle.has_limit(at.face));
  at.sub = std::uniform_int_distribution<int>(0, oracle.sub_count(at.face) - 1)(random);
  at.u = unit(random), at.v = unit(random);
  if (oracle.triangular() && at.u + at.v > 1) at.u = 1 - at.u, at.v = 1 - at.v;
  return at;
}

/// Moves a parameter towards one of the corners: to `factor` times its distance.
inline SurfaceParameter towards_corner(SurfaceParameter at, bool triangular, int corner, double factor) {
  constexpr double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  const double* c = triangular ? triangle[corner % 3] : square[corner % 4];
  at.u = c[0] + factor * (at.u - c[0]), at.v = c[1] + factor * (at.v - c[1]);
  return at;
}

}  // namespace shaolin::oracle_test
