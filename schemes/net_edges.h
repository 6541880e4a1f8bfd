#pragma once
/// The edges of a patch's control net.
#include <array>
#include <vector>

#include "ring.h"

namespace shaolin {

/// The edges of the faces around a face's corners as pairs of vertices, each edge once: edges are told apart by name,
/// so two that join the same vertices are two. `own_only`: of the face itself.
///
/// What lies beyond sharp edges is left out, semi-sharp ones too as long as they count in full (from 1 on): it has no
/// say in the points of the next level on this side. Where two or more such edges end at a corner, only the faces
/// between them that hold this one count; one alone leaves both sides connected.
std::vector<std::array<int, 2>> net_edges(const Neighbourhood& neighbourhood, bool own_only);

}  // namespace shaolin
