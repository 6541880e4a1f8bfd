#include "closed_ring.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "sharpness.h"

namespace shaolin {

ClosedRing::ClosedRing(const Ring& ring, std::size_t low, std::size_t high) : ring_(ring) {
  const int spokes = static_cast<int>(ring.spokes.size());
  int barriers = 0;
  for (const Ring::Spoke& spoke : ring.spokes) barriers += is_infinite(spoke.sharpness);
  open_ = !ring.closed || barriers >= 2 || (barriers == 1 && is_infinite(ring.sharpness));
  if (!open_) {
    faces_ = static_cast<int>(ring.faces.size());
    start_ = static_cast<int>(low);
    return;
  }
  const auto is_end = [&](int i) {
    return (!ring.closed && (i == 0 || i == spokes - 1)) ||
           is_infinite(ring.spokes[static_cast<std::size_t>((i + spokes) % spokes)].sharpness);
  };
  int first = static_cast<int>(low), last = static_cast<int>(high);
  while (!is_end(first)) --first;
  while (!is_end(last)) ++last;
  faces_ = last - first;
  start_ = static_cast<int>(low) - first;
  first_ = (first + spokes) % spokes;
}

void ClosedRing::add_to(Stencil& stencil, const RingMask& mask) const {
  const int n = valence();
  assert(static_cast<int>(mask.edges.size()) == n);
  stencil.add(ring_.vertex, mask.vertex);
  for (int i = 0; i < n; ++i) {
    const double weight = mask.edges[static_cast<std::size_t>(i)];
    const int at = (start_ + i) % n;
    if (!open_ || at <= faces_) {
      stencil.add(spoke(at).end, weight);
    } else {
      stencil.add(spoke(n - at).end, -weight);
      add_twice_foot(stencil, n - at, 1, weight);
    }
  }
  for (int i = 0; i < static_cast<int>(mask.diagonals.size()); ++i) {
    const double weight = mask.diagonals[static_cast<std::size_t>(i)];
    const int at = (start_ + i) % n;
    if (!open_ || at < faces_) {
      add_diagonal(stencil, at, weight);
    } else {
      add_diagonal(stencil, n - 1 - at, -weight);
      add_twice_foot(stencil, n - at - 0.5, std::numbers::sqrt2, weight);
    }
  }
}

void ClosedRing::add_diagonal(Stencil& stencil, int i, double weight) const {
  if (face(i).size() == 4) return stencil.add(face(i).vertex(2), weight);
  stencil.add(spoke(i).end, weight);
  stencil.add(spoke(i + 1).end, weight);
  stencil.add(ring_.vertex, -weight);
}

/// Twice the foot of a point of the sector at that distance from the vertex, whose spokes have distance 1.
void ClosedRing::add_twice_foot(Stencil& stencil, double spokes_from_crease, double distance, double weight) const {
  const double along = distance * std::cos(spokes_from_crease * std::numbers::pi / faces_);
  stencil.add(ring_.vertex, 2 * weight * (1 - std::abs(along)));
  stencil.add(spoke(along > 0 ? 0 : faces_).end, 2 * weight * std::abs(along));
}

}  // namespace shaolin
