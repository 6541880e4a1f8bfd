#include "half_edges.h"

#include <numeric>

namespace shaolin {

void HalfEdges::pair(const SidesByEdge& edges) {
  twins_.resize(static_cast<std::size_t>(side_count()));
  std::iota(twins_.begin(), twins_.end(), 0);
  edges.for_each_edge([&](std::span<const int> sides) {
    if (is_degenerate(sides[0])) {
      degenerate_side_count_ += static_cast<int>(sides.size());
      return;
    }
    ++edge_count_;
    if (sides.size() == 1) return;
    if (sides.size() > 2 || from(sides[0]) == from(sides[1])) {
      misfit_ = sides.back();
      return;
    }
    twins_[static_cast<std::size_t>(sides[0])] = sides[1];
    twins_[static_cast<std::size_t>(sides[1])] = sides[0];
  });
}

bool HalfEdges::is_manifold() const {
  if (misfit_ >= 0 || degenerate_side_count_ > 0) return false;
  std::vector<char> is_seen(twins_.size(), 0), has_fan(mesh_->positions.size(), 0);
  for (int corner = 0; corner < side_count(); ++corner) {
    if (twin(corner) != corner && face(twin(corner)) == face(corner)) return false;
    if (is_seen[static_cast<std::size_t>(corner)]) continue;
    char& fan = has_fan[static_cast<std::size_t>(from(corner))];
    if (fan) return false;
    fan = 1;
    int first = corner;
    for (int at = clockwise(corner); at >= 0 && at != corner; at = clockwise(at)) first = at;
    for (int at = first; at >= 0 && !is_seen[static_cast<std::size_t>(at)]; at = counter_clockwise(at))
      is_seen[static_cast<std::size_t>(at)] = 1;
  }
  return true;
}

}  // namespace shaolin
