#include "tools/stress/meshes.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "tools/validate/random.h"

namespace shaolin::stress {

namespace {

constexpr double pi = std::numbers::pi;
constexpr float infinite = std::numeric_limits<float>::infinity();

using Faces = std::vector<std::vector<int>>;

ControlMesh mesh_of(std::vector<Vec3> points, const Faces& faces) {
  ControlMesh mesh;
  mesh.positions = std::move(points);
  for (const auto& face : faces) mesh.add_face(face);
  return mesh;
}

/// So that no symmetry hides a fault.
ControlMesh shaken(ControlMesh mesh, double amount) {
  SampleRandom random(1);
  for (Vec3& point : mesh.positions) point += amount * random.direction();
  return mesh;
}

/// A cell of a grid: a quad, or two triangles along the diagonal a-c.
void add_cell(Faces& faces, bool quads, int a, int b, int c, int d) {
  if (quads)
    faces.push_back({a, b, c, d});
  else
    faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
}

const char* scheme_of(bool quads) { return quads ? "catmark" : "loop"; }
std::string suffix_of(bool quads) { return quads ? "_quads" : "_triangles"; }

ControlMesh torus(bool quads, int around, int along) {
  std::vector<Vec3> points;
  Faces faces;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * pi * i / around, b = 2 * pi * j / along;
      points.emplace_back((3 + std::cos(a)) * std::cos(b), (3 + std::cos(a)) * std::sin(b), std::sin(a));
    }
  const auto at = [&](int i, int j) { return j % along * around + i % around; };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) add_cell(faces, quads, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
  return mesh_of(points, faces);
}

/// A closed body with two poles, vertices 0 and 1, of valence n: a bipyramid over a rim of n, or a trapezohedron over a
/// zigzag rim of 2 n vertices.
ControlMesh poles(bool quads, int n) {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  Faces faces;
  const int rim = quads ? 2 * n : n;
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * pi * i / rim;
    points.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), quads ? (i % 2 ? -0.3 : 0.3) : 0.0);
  }
  const auto at = [&](int i) { return 2 + (i + rim) % rim; };
  for (int i = 0; i < n; ++i)
    if (quads)
      faces.insert(faces.end(),
                   {{0, at(2 * i), at(2 * i + 1), at(2 * i + 2)}, {1, at(2 * i + 1), at(2 * i), at(2 * i - 1)}});
    else
      faces.insert(faces.end(), {{0, at(i), at(i + 1)}, {1, at(i + 1), at(i)}});
  return mesh_of(points, faces);
}

ControlMesh sheet(bool quads, int columns, int rows) {
  std::vector<Vec3> points;
  Faces faces;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) points.emplace_back(i, j, 0.3 * std::sin(1.3 * i) * std::cos(0.9 * j));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, d = a + columns + 1;
      add_cell(faces, quads, a, a + 1, d + 1, d);
    }
  return mesh_of(points, faces);
}

ControlMesh cube() {
  return mesh_of({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
                 {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Meridians and parallels of a unit sphere; its poles are vertices of valence 2 `half`.
ControlMesh sphere(bool quads, int half) {
  const int around = 2 * half;
  std::vector<Vec3> points{{0, 0, 1}};
  for (int j = 1; j < half; ++j)
    for (int i = 0; i < around; ++i) {
      const double latitude = pi * j / half, longitude = 2 * pi * i / around;
      points.emplace_back(std::sin(latitude) * std::cos(longitude), std::sin(latitude) * std::sin(longitude),
                          std::cos(latitude));
    }
  points.emplace_back(0, 0, -1);
  const int south = static_cast<int>(points.size()) - 1;
  const auto at = [&](int i, int j) { return 1 + (j - 1) * around + i % around; };
  Faces faces;
  for (int i = 0; i < around; ++i) {
    faces.push_back({0, at(i, 1), at(i + 1, 1)});
    for (int j = 1; j < half - 1; ++j) add_cell(faces, quads, at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    faces.push_back({south, at(i + 1, half - 1), at(i, half - 1)});
  }
  return mesh_of(points, faces);
}

ControlMesh with_edges(ControlMesh mesh, std::vector<SharpEdge> edges) {
  mesh.sharp_edges = std::move(edges);
  return mesh;
}

/// A torus whose points are moved by `change`.
template <class Change>
StressModel changed_torus(const std::string& name, bool quads, Change change) {
  ControlMesh mesh = shaken(torus(quads, 4, 6), 0.1);
  change(mesh.positions);
  return {name + suffix_of(quads), mesh, scheme_of(quads)};
}

}  // namespace

std::vector<StressModel> sound_models() {
  std::vector<StressModel> models;
  for (const bool quads : {true, false}) {
    const std::string suffix = suffix_of(quads), scheme = scheme_of(quads);
    models.push_back({"torus" + suffix, shaken(torus(quads, 4, 6), 0.1), scheme});
    models.push_back({"poles" + suffix, shaken(poles(quads, 7), 0.1), scheme});
    const std::vector<SharpEdge> creases{{0, 2, 10}, {0, quads ? 6 : 4, 2.5f}, {1, 3, infinite}, {1, 5, 10}};
    models.push_back({"creases" + suffix, with_edges(shaken(poles(quads, 5), 0.1), creases), scheme});
    models.push_back({"sheet" + suffix, with_edges(sheet(quads, 4, 3), {{6, 7, 10}}), scheme});
  }
  return models;
}

std::vector<StressModel> distant_spheres() {
  std::vector<StressModel> models;
  for (const bool quads : {true, false}) {
    ControlMesh mesh = sphere(quads, 8);
    // The limit of a net on the unit sphere lies inside of it; by 3 hundredths here, which is no matter.
    for (Vec3& point : mesh.positions) point = 2 * point + Vec3(148376, 1234, -223423);
    models.push_back({"sphere" + suffix_of(quads), mesh, scheme_of(quads)});
  }
  return models;
}

std::vector<StressModel> degenerate_models() {
  std::vector<StressModel> models;
  for (const bool quads : {true, false}) {
    using Points = std::vector<Vec3>;
    const auto add = [&](const std::string& name, auto change) {
      models.push_back(changed_torus(name, quads, change));
    };
    add("slivers", [](Points& points) {
      for (Vec3& p : points) p.z() *= 1e-9;
    });
    add("flat", [](Points& points) {
      for (Vec3& p : points) p.z() = 0;
    });
    add("collapsed_edge", [](Points& points) { points[1] = points[0]; });
    add("collapsed_ring", [](Points& points) { points[1] = points[2] = points[3] = points[0]; });
    add("nearly_collapsed", [](Points& points) { points[1] = points[0] + Vec3(1e-15, 0, 0); });
    add("needle", [](Points& points) { points[0] *= 1e6; });
    add("cap", [](Points& points) { points[1] = 0.5 * (points[0] + points[2]) + Vec3(0, 0, 1e-12); });
    add("collinear", [](Points& points) {
      for (Vec3& p : points) p = p.x() * Vec3(1, 2, 3);
    });
    add("one_point", [](Points& points) {
      for (Vec3& p : points) p = Vec3(1, 2, 3);
    });
    add("folded", [](Points& points) {
      for (Vec3& p : points) p.y() = std::abs(p.y());
    });
    add("inverted", [](Points& points) { points[5] = -points[5]; });
  }
  // A chain of quads so long that single faces are slivers of 1 to 1e6.
  ControlMesh ribbon = sheet(true, 3, 3);
  for (Vec3& p : ribbon.positions) p.x() *= 1e6;
  models.push_back({"ribbon", ribbon, "catmark"});
  models.push_back({"repeated_corner",
                    mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}}, {{0, 1, 1, 2}, {0, 2, 3, 3}}), "catmark"});
  return models;
}

std::vector<StressModel> valence_models() {
  std::vector<StressModel> models;
  for (const bool quads : {true, false})
    for (const int valence : {3, 4, 5, 6, 7, 12, 30, 100}) {
      const std::string name = "valence_" + std::to_string(valence) + suffix_of(quads);
      models.push_back({name, poles(quads, valence), scheme_of(quads)});
    }
  models.push_back({"valence_1000_triangles", poles(false, 1000), "loop"});
  models.push_back({"valence_2_quads",
                    mesh_of({{0, 0, 0.5},
                             {1, 0, 0},
                             {0, 1, 0},
                             {-1, 0, 0},
                             {0, -1, 0},
                             {2, 0, 0.3},
                             {0, 2, 0},
                             {-2, 0, 0.3},
                             {0, -2, 0}},
                            {{0, 1, 2, 3}, {0, 3, 4, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}),
                    "catmark"});
  models.push_back(
      {"valence_2_triangles", mesh_of({{0, 0, 0}, {1, 0, 0.2}, {0.3, 1, 0}}, {{0, 1, 2}, {1, 0, 2}}), "loop"});
  return models;
}

std::vector<StressModel> sharpness_models() {
  std::vector<StressModel> models;
  const std::pair<float, const char*> sharpnesses[] = {
      {0.1f, "0.1"}, {3.5f, "3.5"}, {9.99f, "9.99"}, {10.0f, "10"}, {infinite, "infinite"}};
  for (const auto& [sharpness, text] : sharpnesses) {
    const ControlMesh quads = shaken(cube(), 0.1), triangles = shaken(poles(false, 4), 0.1);
    const std::string name = std::string("sharpness_") + text;
    models.push_back({name + "_loop_of_edges",
                      with_edges(quads, {{0, 1, sharpness}, {1, 2, sharpness}, {2, 3, sharpness}, {3, 0, sharpness}}),
                      "catmark"});
    models.push_back({name + "_dart_quads", with_edges(quads, {{4, 5, sharpness}}), "catmark"});
    models.push_back({name + "_dart_triangles", with_edges(triangles, {{0, 2, sharpness}}), "loop"});
    models.push_back({name + "_corner_triangles",
                      with_edges(triangles, {{0, 2, sharpness}, {0, 3, sharpness}, {0, 4, sharpness}}), "loop"});
    models.push_back({name + "_chaikin",
                      with_edges(quads, {{0, 1, sharpness}, {1, 2, 0.5f * std::min(sharpness, 10.0f)}}), "catmark"});
    models.back().mesh.crease_method = CreaseMethod::chaikin;
  }
  return models;
}

}  // namespace shaolin::stress
