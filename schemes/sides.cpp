#include "sides.h"

#include <algorithm>
#include <numeric>

namespace shaolin {

Sides::Sides(const PolygonMesh& mesh) : mesh_(&mesh) {
  size_ = mesh.face_count() == 0 ? 0 : mesh.face_size(0);
  for (int f = 0; f < mesh.face_count(); ++f)
    if (mesh.face_size(f) != size_) size_ = 0;
  if (size_ == 3 || size_ == 4) return;
  faces_.reserve(mesh.face_vertices.size());
  for (int f = 0; f < mesh.face_count(); ++f)
    faces_.insert(faces_.end(), static_cast<std::size_t>(mesh.face_size(f)), f);
}

/// By counting, then within the few sides of each lower vertex.
SidesByEdge::SidesByEdge(const Sides& sides) : sides_(&sides), order_(static_cast<std::size_t>(sides.side_count())) {
  int vertices = 0;
  for (int s = 0; s < sides.side_count(); ++s) vertices = std::max(vertices, sides.from(s) + 1);
  std::vector<int> ends(static_cast<std::size_t>(vertices) + 1, 0);
  const auto lower = [&](int side) { return static_cast<std::size_t>(std::min(sides.from(side), sides.to(side))); };
  for (int s = 0; s < sides.side_count(); ++s) ++ends[lower(s) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  for (int s = 0; s < sides.side_count(); ++s) order_[static_cast<std::size_t>(ends[lower(s)]++)] = s;

  std::vector<std::pair<int, int>> group;  // higher vertex, side
  std::size_t begin = 0;                   // each entry of `ends` has moved on to its vertex's end
  for (std::size_t v = 0; v < static_cast<std::size_t>(vertices); begin = static_cast<std::size_t>(ends[v++])) {
    const std::span<int> own = std::span(order_).subspan(begin, static_cast<std::size_t>(ends[v]) - begin);
    group.clear();
    for (const int side : own) group.emplace_back(std::max(sides.from(side), sides.to(side)), side);
    std::sort(group.begin(), group.end());
    std::transform(group.begin(), group.end(), own.begin(), [](const auto& entry) { return entry.second; });
  }
}

}  // namespace shaolin
