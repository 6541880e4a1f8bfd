#include "net_edges.h"

#include <algorithm>
#include <unordered_set>

#include "neighbourhood.h"

namespace shaolin {

namespace {

/// The places of the ring's faces that the one in `place` is connected to without crossing a sharp edge.
std::vector<std::size_t> sector_of(const Ring& ring, std::size_t place) {
  const std::size_t faces = ring.faces.size(), spokes = ring.spokes.size();
  const auto cuts = [&](std::size_t spoke) { return ring.spokes[spoke].sharpness >= 1; };
  std::vector<std::size_t> sector;
  const auto in_full = std::count_if(ring.spokes.begin(), ring.spokes.end(),
                                     [](const Ring::Spoke& spoke) { return spoke.sharpness >= 1; });
  if (in_full < 2) {
    for (std::size_t i = 0; i < faces; ++i) sector.push_back(i);
    return sector;
  }
  // Face i lies between spokes i and i + 1; an open ring ends at its first and last spoke.
  for (std::size_t i = place, left = faces; left > 0; --left) {
    sector.push_back(i);
    if (cuts((i + 1) % spokes) || (!ring.closed && i + 1 == faces)) break;
    i = (i + 1) % faces;
  }
  for (std::size_t i = place; sector.size() < faces;) {
    if (cuts(i) || (!ring.closed && i == 0)) break;
    i = (i + faces - 1) % faces;
    sector.push_back(i);
  }
  return sector;
}

}  // namespace

std::vector<std::array<int, 2>> net_edges(const Neighbourhood& neighbourhood, bool own_only) {
  std::vector<std::array<int, 2>> edges;
  std::unordered_set<int> known;
  const auto add = [&](const FaceSides& face) {
    for (int i = 0; i < face.size(); ++i)
      if (known.insert(face.side(i)).second) edges.push_back({face.vertex(i), face.vertex((i + 1) % face.size())});
  };
  add(neighbourhood.face);
  if (own_only) return edges;
  const auto corners = static_cast<std::size_t>(neighbourhood.face.size());
  for (std::size_t k = 0; k < neighbourhood.rings.size(); ++k) {
    const Ring& ring = neighbourhood.rings[k];
    if (k < corners) {
      for (const std::size_t i : sector_of(ring, static_cast<std::size_t>(place_of_face(neighbourhood, k))))
        add(ring.faces[i]);
    } else {
      for (const FaceSides& face : ring.faces) add(face);
    }
  }
  return edges;
}

}  // namespace shaolin
