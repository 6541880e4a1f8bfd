#include "crease_strips.h"

#include <algorithm>

#include "sharpness.h"

namespace shaolin {

CreaseStrips::CreaseStrips(int side, float sharpness, std::vector<SplinePoint> grid) : grid_(std::move(grid)) {
  // A refined line: edge point, vertex point, edge point, ... of the line before, from the edge p0-p1 on.
  const Eigen::RowVector4d edge(0.5, 0.5, 0, 0), vertex(0.125, 0.75, 0.125, 0);
  const auto shifted = [](const Eigen::RowVector4d& row) { return Eigen::RowVector4d(0, row[0], row[1], row[2]); };
  Eigen::Matrix4d line = Eigen::Matrix4d::Identity();  // spline points = line * (p0, p1, p2, p3)
  double width = 1;
  for (; is_sharp(sharpness); sharpness = decayed(sharpness), width /= 2) {
    const double stays = std::min(1.0, static_cast<double>(sharpness));
    const Eigen::RowVector4d kept = stays * Eigen::RowVector4d(0, 1, 0, 0) + (1 - stays) * vertex;
    Eigen::Matrix4d nearer, farther;
    nearer << edge, kept, shifted(edge), shifted(vertex);
    farther << kept, shifted(edge), shifted(vertex), shifted(shifted(edge));
    add(side, width / 2, width, farther * line);
    line = nearer * line;
  }
  add(side, 0, width, line);
}

/// Between two distances from the crease. The side runs from the face's corner of that number to the next: lines count
/// away from it, and the grid's rows and columns away from sides 0 and 3.
void CreaseStrips::add(int side, double from, double to, const Eigen::Matrix4d& line) {
  const bool from_below = side == 0 || side == 3;
  const Eigen::Index axis = side % 2 == 0 ? 1 : 0;
  const Eigen::Matrix4d turned = from_below ? line : Eigen::Matrix4d(line.reverse());
  const BezierQuad::LineMap along = BezierQuad::spline_map();
  const BezierQuad::LineMap across{along.matrix * turned, BezierQuad::LineMap::Kind::other};
  Strip& strip = strips_.emplace_back(Strip{SubDomain(), {axis == 0 ? across : along, axis == 0 ? along : across}});
  strip.domain.origin[axis] = from_below ? from : 1 - to;
  strip.domain.scale[axis] = to - from;
}

std::array<Vec3, 16> CreaseStrips::grid(const Vec3* points) const {
  std::array<Vec3, 16> grid;
  for (std::size_t i = 0; i < 16; ++i) grid[i] = grid_[i].of(points);
  return grid;
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
