#include "tools/conformance/vertex_star.h"

#include <array>
#include <cmath>
#include <numbers>

namespace shaolin {

std::string to_string(StarKind kind) {
  constexpr std::array names{"smooth", "dart", "crease", "corner"};
  return names[static_cast<std::size_t>(kind)];
}

/// A closed star gets a second centre below, so that it has no boundary; its rim has regular-enough vertices of valence
/// 3 or 4, which patches leave behind after a split.
ControlMesh vertex_star(FaceKind face_kind, StarKind kind, int faces) {
  const bool closed = kind == StarKind::smooth || kind == StarKind::dart;
  const int step = face_kind == FaceKind::quad ? 2 : 1, rim = step * faces + !closed;
  const double turn = (closed ? 2 : 1) * std::numbers::pi / (step * faces);
  ControlMesh mesh;
  mesh.positions.emplace_back(0, 0, 0);
  for (int i = 0; i < rim; ++i) {
    const double radius = step == 2 && i % 2 ? std::sqrt(2) : 1;
    mesh.positions.emplace_back(radius * std::cos(turn * i), radius * std::sin(turn * i), 0);
  }
  const auto at = [&](int i) { return 1 + (i + rim) % rim; };
  const auto add = [&](std::vector<int> corners) { mesh.add_face(corners); };
  for (int i = 0; i < faces; ++i)
    step == 2 ? add({0, at(2 * i), at(2 * i + 1), at(2 * i + 2)}) : add({0, at(i), at(i + 1)});
  if (closed) {
    const int below = static_cast<int>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, -1);
    for (int i = 0; i < faces; ++i)
      step == 2 ? add({below, at(2 * i + 1), at(2 * i), at(2 * i - 1)}) : add({below, at(i + 1), at(i)});
  }
  if (kind == StarKind::dart) mesh.sharp_edges.push_back({0, at(0), infinite_sharpness});
  if (kind == StarKind::corner) mesh.sharp_vertices.push_back({0, infinite_sharpness});
  if (kind == StarKind::crease) mesh.boundary = BoundaryInterpolation::edge_only;
  return mesh;
}

}  // namespace shaolin
