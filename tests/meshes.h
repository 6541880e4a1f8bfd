#pragma once
// Small meshes by name, symmetric where that is simplest; shaken() takes the symmetry away.
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "schemes/control_mesh.h"
#include "tests/random.h"

namespace shaolin {

inline ControlMesh mesh_of(std::vector<Vec3> points, const std::vector<std::vector<int>>& faces) {
  ControlMesh mesh;
  mesh.positions = std::move(points);
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

/// Moves every point by up to `amount` per coordinate, so that no symmetry hides a wrong weight.
inline ControlMesh shaken(ControlMesh mesh, double amount, std::uint64_t seed = 1) {
  Random random(seed);
  for (Vec3& p : mesh.positions) p += amount * random.point();
  return mesh;
}

/// A closed mesh of the scheme's own faces with two poles, vertices 0 and 1, of valence n >= 3 (quads: a trapezohedron
/// over a zigzag rim of 2 n vertices; triangles: a bipyramid over a rim of n).
inline ControlMesh poles(const std::string& scheme, int n) {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  std::vector<std::vector<int>> faces;
  const bool quads = scheme == "catmark";
  const int rim = quads ? 2 * n : n;
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * std::numbers::pi * i / rim;
    points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), quads ? (i % 2 ? -0.3 : 0.3) : 0.0);
  }
  const auto at = [&](int i) { return 2 + (i + rim) % rim; };
  for (int i = 0; i < n; ++i) {
    if (quads) {
      faces.push_back({0, at(2 * i), at(2 * i + 1), at(2 * i + 2)});
      faces.push_back({1, at(2 * i + 1), at(2 * i), at(2 * i - 1)});
    } else {
      faces.push_back({0, at(i), at(i + 1)});
      faces.push_back({1, at(i + 1), at(i)});
    }
  }
  return mesh_of(points, faces);
}

/// A cell of a grid: one quad, or two triangles along the diagonal a-c.
inline void add_cell(std::vector<std::vector<int>>& faces, const std::string& scheme, int a, int b, int c, int d) {
  if (scheme == "catmark") {
    faces.push_back({a, b, c, d});
  } else {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
}

/// An open sheet of columns x rows quads (or twice as many triangles), vertex j (columns + 1) + i at (i, j, 0).
inline ControlMesh sheet(const std::string& scheme, int columns, int rows) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) points.emplace_back(i, j, 0);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, d = a + columns + 1, c = d + 1;
      add_cell(faces, scheme, a, b, c, d);
    }
  return mesh_of(points, faces);
}

/// A closed torus, regular everywhere: vertex j around + i; around, along >= 3.
inline ControlMesh torus(const std::string& scheme, int around, int along) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along;
      points.emplace_back((3 + std::cos(a)) * std::cos(b), (3 + std::cos(a)) * std::sin(b), std::sin(a));
    }
  const auto at = [&](int i, int j) { return j % along * around + i % around; };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      add_cell(faces, scheme, a, b, c, d);
    }
  return mesh_of(points, faces);
}

/// Two n-gons and n quads between them; vertex 2 i below, 2 i + 1 above. Face 0 is the lower n-gon, face 1 the upper.
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

/// A fan of k of the scheme's faces around vertex 0, open: its sector of a crease or boundary vertex. Rim vertices
/// follow counter-clockwise: spokes and diagonals alternate for quads.
inline ControlMesh fan(const std::string& scheme, int k) {
  std::vector<Vec3> points{{0, 0, 0}};
  std::vector<std::vector<int>> faces;
  const int step = scheme == "catmark" ? 2 : 1;
  for (int i = 0; i <= step * k; ++i) {
    const double angle = std::numbers::pi * i / (step * k);
    points.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  for (int i = 0; i < k; ++i) {
    const int a = 1 + step * i;
    faces.push_back(step == 2 ? std::vector{0, a, a + 1, a + 2} : std::vector{0, a, a + 1});
  }
  return mesh_of(points, faces);
}

/// Faces 0 and 1 are the bottom and the top.
inline ControlMesh cube() {
  return mesh_of({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
                 {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

inline ControlMesh tetrahedron() {
  return mesh_of({{-1, -1, 1}, {1, -1, -1}, {1, 1, 1}, {-1, 1, -1}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {3, 2, 1}});
}

/// Interior valence 2: vertex 0, the middle one of two quads that share two edges, inside a ring of quads.
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

}  // namespace shaolin
