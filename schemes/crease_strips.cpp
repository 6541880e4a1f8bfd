#include "crease_strips.h"

#include <algorithm>

#include "sharpness.h"

namespace shaolin {

CreaseStrips::CreaseStrips(int side, float sharpness, std::vector<SplinePoint> grid)
    : side_(side), grid_(std::move(grid)) {
  // A refined line: edge point, vertex point, edge point, ... of the line before, from the edge p0-p1 on.
  const Eigen::RowVector4d edge(0.5, 0.5, 0, 0), vertex(0.125, 0.75, 0.125, 0);
  const auto shifted = [](const Eigen::RowVector4d& row) { return Eigen::RowVector4d(0, row[0], row[1], row[2]); };
  LineMap line = LineMap::Identity();
  double width = 1;
  for (; is_sharp(sharpness); sharpness = decayed(sharpness), width /= 2) {
    const double stays = std::min(1.0, static_cast<double>(sharpness));
    const Eigen::RowVector4d kept = stays * Eigen::RowVector4d(0, 1, 0, 0) + (1 - stays) * vertex;
    LineMap nearer, farther;
    nearer << edge, kept, shifted(edge), shifted(vertex);
    farther << kept, shifted(edge), shifted(vertex), shifted(shifted(edge));
    across_.push_back({width / 2, width, farther * line});
    line = nearer * line;
  }
  across_.push_back({0, width, line});
}

std::vector<CreaseStrips::Strip> CreaseStrips::strips(const Vec3* points) const {
  // The place in the grid of the point `along` the crease and so many lines `away` from the one beyond it.
  const auto place = [&](std::size_t along, std::size_t away) {
    const std::size_t line = side_ == 0 || side_ == 3 ? away : 3 - away;
    return side_ % 2 == 0 ? 4 * line + along : 4 * along + line;
  };
  const Eigen::Index axis = side_ % 2 == 0 ? 1 : 0;
  std::vector<Strip> result;
  for (const Across& across : across_) {
    std::array<Vec3, 16> spline;
    for (std::size_t along = 0; along < 4; ++along) {
      std::array<Vec3, 4> line;
      for (std::size_t away = 0; away < 4; ++away) line[away] = grid_[place(along, away)].of(points);
      for (std::size_t away = 0; away < 4; ++away) {
        const auto weights = across.map.row(static_cast<Eigen::Index>(away));
        spline[place(along, away)] =
            (weights[0] * line[0] + weights[1] * line[1]) + (weights[2] * line[2] + weights[3] * line[3]);
      }
    }
    Strip& strip = result.emplace_back(Strip{SubDomain(), BezierQuad::from_spline(spline)});
    strip.domain.origin[axis] = side_ == 0 || side_ == 3 ? across.from : 1 - across.to;
    strip.domain.scale[axis] = across.to - across.from;
  }
  return result;
}

namespace {

/// The sharpness of a regular corner's spokes, counter-clockwise from the face's outgoing edge; empty for others.
std::optional<std::array<float, 4>> spokes_of_regular(const Neighbourhood& n, std::size_t k) {
  const Ring& ring = n.rings[k];
  const bool quads = std::all_of(ring.faces.begin(), ring.faces.end(), [](const auto& f) { return f.size() == 4; });
  if (!ring.closed || ring.cone || is_sharp(ring.sharpness) || ring.faces.size() != 4 || !quads) return {};
  std::array<float, 4> sharpness;
  const auto place = static_cast<std::size_t>(place_of_face(n, k));
  for (std::size_t i = 0; i < 4; ++i) sharpness[i] = ring.spokes[(place + i) % 4].sharpness;
  return sharpness;
}

}  // namespace

std::optional<CreaseStrips> crease_strips(const Neighbourhood& neighbourhood) {
  if (neighbourhood.face.size() != 4) return {};
  std::array<std::array<float, 4>, 4> spokes;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto sharpness = spokes_of_regular(neighbourhood, k);
    if (!sharpness) return {};
    spokes[k] = *sharpness;
  }
  for (std::size_t side = 0; side < 4; ++side) {
    const float s = spokes[side][0];
    if (!is_semi_sharp(s)) continue;
    // The side leaves its first corner by spoke 0 and comes to its last by spoke 1; a crease goes on straight.
    constexpr std::array<float, 4> smooth{};
    const bool is_alone = spokes[side] == std::array{s, 0.0F, s, 0.0F} &&
                          spokes[(side + 1) % 4] == std::array{0.0F, s, 0.0F, s} && spokes[(side + 2) % 4] == smooth &&
                          spokes[(side + 3) % 4] == smooth;
    if (is_alone) return CreaseStrips(static_cast<int>(side), s, bicubic_grid(neighbourhood));
  }
  return {};
}

}  // namespace shaolin
