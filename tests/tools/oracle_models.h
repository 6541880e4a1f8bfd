#pragma once
// Small meshes with every kind of feature, and random places on them, for the tests of the oracle and the dense check.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "schemes/control_mesh.h"
#include "tools/validate/oracle.h"

namespace shaolin::oracle_test {

struct Model {
  std::string name, scheme;
  ControlMesh mesh;
};

inline ControlMesh mesh_of(std::vector<Vec3> points, const std::vector<std::vector<int>>& faces) {
  ControlMesh mesh;
  mesh.positions = std::move(points);
  // No symmetry: a wrong weight must not cancel.
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double k = static_cast<double>(i);
    mesh.positions[i] += 0.13 * Vec3(std::sin(3 * k + 1), std::sin(5 * k + 2), std::sin(7 * k + 3));
  }
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

inline ControlMesh cube() {
  return mesh_of({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
                 {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

inline ControlMesh tetrahedron() {
  return mesh_of({{-1, -1, 1}, {1, -1, -1}, {1, 1, 1}, {-1, 1, -1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}});
}

/// A prism over an n-gon: two n-gons, n quads.
inline ControlMesh prism(int n) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces(2);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.emplace_back(std::cos(angle), std::sin(angle), -1);
    points.emplace_back(std::cos(angle), std::sin(angle), 1);
    faces[0].insert(faces[0].begin(), 2 * i);
    faces[1].push_back(2 * i + 1);
    const int j = (i + 1) % n;
    faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  return mesh_of(points, faces);
}

/// A double pyramid: two poles of valence n; triangles.
inline ControlMesh pyramids(int n) {
  std::vector<Vec3> points{{0, 0, 1.5}, {0, 0, -1.5}};
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), 0);
    const int a = 2 + i, b = 2 + (i + 1) % n;
    faces.push_back({a, b, 0});
    faces.push_back({b, a, 1});
  }
  return mesh_of(points, faces);
}

/// An open sheet of m x n quads, or of twice as many triangles.
inline ControlMesh sheet(int m, int n, bool triangles) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= m; ++i) points.emplace_back(i, j, 0.3 * i * j);
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < m; ++i) {
      const int a = j * (m + 1) + i, b = a + 1, c = b + m + 1, d = a + m + 1;
      if (triangles) {
        faces.push_back({a, b, c});
        faces.push_back({c, d, a});
      } else {
        faces.push_back({a, b, c, d});
      }
    }
  }
  return mesh_of(points, faces);
}

/// Interior valence 2: the middle vertex of two quads that share two edges, inside a ring of quads.
inline ControlMesh valence_two() {
  return mesh_of(
      {{0, 0, 0.5}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {2, 0, 0.3}, {0, 2, 0}, {-2, 0, 0.3}, {0, -2, 0}},
      {{0, 1, 2, 3}, {0, 3, 4, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}});
}

/// Two triangles back to back: three interior vertices of valence 2, and two edges between the same points after a
/// step. Its limit is flat and folded at the edges.
inline ControlMesh pillow() { return mesh_of({{0, 0, 0}, {1, 0, 0.2}, {0.3, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}); }

inline ControlMesh with_edges(ControlMesh mesh, std::vector<SharpEdge> edges,
                              CreaseMethod method = CreaseMethod::uniform) {
  mesh.sharp_edges = std::move(edges);
  mesh.crease_method = method;
  return mesh;
}

inline ControlMesh with_boundary(ControlMesh mesh, BoundaryInterpolation boundary) {
  mesh.boundary = boundary;
  return mesh;
}

/// Semi-sharp tags stay below the levels that brute force refines.
inline std::vector<Model> models() {
  std::vector<Model> all;
  for (const std::string scheme : {"catmark", "loop"}) {
    const bool loop = scheme == "loop";
    const auto add = [&](const std::string& name, ControlMesh mesh) {
      all.push_back({scheme + " " + name, scheme, std::move(mesh)});
    };
    const ControlMesh body = loop ? pyramids(5) : cube();
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
    add("edge only", with_boundary(sheet(2, 3, loop), BoundaryInterpolation::edge_only));
    add("edge and corner", sheet(2, 3, loop));
    ControlMesh chain = sheet(4, 4, loop);
    chain.sharp_edges = {{10, 11, 5}, {11, 12, 1}, {12, 13, 1.5f}, {7, 12, 3}, {12, 17, 0.5f}};
    chain.crease_method = CreaseMethod::chaikin;
    add("Chaikin, uneven", chain);
    add("no boundary", with_boundary(sheet(4, 4, loop), BoundaryInterpolation::none));
    if (loop) continue;
    add("prism", with_edges(prism(5), {{0, 1, 10}, {1, 3, 1.7f}}));
    ControlMesh smooth_triangles = pyramids(5);
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
