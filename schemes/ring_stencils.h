#pragma once
/// The new points of one refinement step of a scheme of radius 2, as stencils. Mesh hierarchy and patch share them.
#include <algorithm>

#include "closed_ring.h"
#include "errors.h"
#include "sharpness.h"

namespace shaolin {

/// `ring_of(vertex)` returns the ring of a vertex, a `const Ring*`; it must know the vertices of the edges and faces
/// that are asked for.
template <Scheme S, class RingOf>
class RingStencils {
 public:
  RingStencils(const Rules<S>& rules, RingOf ring_of) : rules_(rules), ring_of_(std::move(ring_of)) {}

  /// The new point of a ring's vertex. Throws InputError if the scheme's mask reads face points, whose own rings reach
  /// beyond the patch.
  Stencil vertex(const Ring& ring) const {
    const VertexTransition to = vertex_transition(ring.sharpness, ring.spoke_sharpness(), ring.half_sharpness());
    const VertexMask mask = rules_.vertex(static_cast<int>(ring.spokes.size()), to, ring.cone);
    if (mask.face != 0) throw InputError("a scheme of radius 2 cannot weigh new face points in its vertex mask");
    Stencil stencil;
    const double share = to.parent_weight;  // in double: float would not give two shares that add up to one
    add_by_rule(stencil, to.parent, to.parent_crease, ring, mask, share);
    if (share < 1) add_by_rule(stencil, to.child, to.child_crease, ring, mask, 1 - share);
    return stencil;
  }

  /// The new point of the edge that is spoke i of a ring.
  Stencil edge(const Ring& ring, std::size_t i) const {
    const Ring::Spoke& spoke = ring.spokes[i];
    const double crease = edge_crease_share(spoke.sharpness, spoke.near_half, spoke.far_half);
    Stencil stencil;
    const Ring* other = crease == 1 ? nullptr : ring_of_(spoke.end);
    if (!other) return midpoint(ring.vertex, spoke.end);
    const auto same = std::find_if(other->spokes.begin(), other->spokes.end(),
                                   [&](const Ring::Spoke& s) { return s.edge == spoke.edge; });
    if (same == other->spokes.end()) return midpoint(ring.vertex, spoke.end);  // beside a repeated vertex
    const ClosedRing here = ClosedRing::at_spoke(ring, i);
    const ClosedRing there = ClosedRing::at_spoke(*other, static_cast<std::size_t>(same - other->spokes.begin()));
    if (std::min(here.valence(), there.valence()) < 3) return midpoint(ring.vertex, spoke.end);
    here.add_to(stencil, rules_.edge_end(here.valence(), there.valence()));
    there.add_to(stencil, rules_.edge_end(there.valence(), here.valence()));
    if (crease == 0) return stencil;
    Stencil blend;
    blend.add(midpoint(ring.vertex, spoke.end), crease);
    blend.add(stencil, 1 - crease);
    return blend;
  }

  /// The new point of a face; of one that is no quad, the mean of its corners.
  Stencil face(const FaceSides& face) const {
    Stencil stencil;
    for (int i = 0; i < face.size(); ++i) {
      const Ring* ring = face.size() == 4 ? ring_of_(face.vertex(i)) : nullptr;
      const int place = ring ? place_in(*ring, face.turned(i)) : -1;
      if (place >= 0) {
        const ClosedRing corner = ClosedRing::at_face(*ring, static_cast<std::size_t>(place));
        if (corner.valence() >= 3) {
          corner.add_to(stencil, rules_.face_corner(corner.valence()));
          continue;
        }
      }
      stencil.add(face.vertex(i), 1.0 / face.size());
    }
    return stencil;
  }

 private:
  static Stencil midpoint(int a, int b) {
    Stencil stencil;
    stencil.add(a, 0.5);
    stencil.add(b, 0.5);
    return stencil;
  }

  static int place_in(const Ring& ring, const FaceSides& face) {
    for (std::size_t i = 0; i < ring.faces.size(); ++i)
      if (ring.faces[i].id() == face.id() && ring.faces[i].side(0) == face.side(0)) return static_cast<int>(i);
    return -1;
  }

  void add_by_rule(Stencil& stencil, VertexRule rule, const std::array<int, 2>& ends, const Ring& ring,
                   const VertexMask& mask, double share) const {
    if (rule == VertexRule::corner) return stencil.add(ring.vertex, share);
    if (rule == VertexRule::crease) {
      const CreaseMask crease = rules_.crease();
      stencil.add(ring.vertex, share * crease.vertex);
      for (const int end : ends) stencil.add(ring.spokes[static_cast<std::size_t>(end)].end, share * crease.edge);
      return;
    }
    stencil.add(ring.vertex, share * mask.vertex);
    for (const Ring::Spoke& spoke : ring.spokes) stencil.add(spoke.end, share * mask.edge);
  }

  const Rules<S>& rules_;
  RingOf ring_of_;
};

}  // namespace shaolin
