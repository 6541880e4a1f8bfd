#pragma once
/// Operations on the topology around a face: its reduction to what matters.
#include <vector>

#include "ring.h"

namespace shaolin {

/// The place of corner k's own face in the corner's ring. (A face that repeats a vertex stands there more than once.)
int place_of_face(const Neighbourhood& neighbourhood, std::size_t k);

/// Opens the rings of the face's corners along infinitely sharp edges and keeps the sector that holds the face: what
/// lies beyond does not influence its patch. A ring is left whole while semi-sharp edges still count for its rule; a
/// sector that was cut out of three or more sharp edges gets an infinitely sharp vertex. A neighbourhood of radius 2 is
/// left with the rings of the vertices of faces around its corners.
void drop_beyond_creases(Neighbourhood& neighbourhood);

/// Turns every closed ring of a corner so that the face comes first (open rings begin at their first edge), and sorts
/// further rings in the order in which a walk around the corners meets them; closed ones begin at the face that it
/// comes from.
void turn_to_face(Neighbourhood& neighbourhood);

/// The vertices and faces of a neighbourhood numbered in the order of a fixed walk, so that equal topology gives equal
/// numbers. `vertices[i]` is the old name of vertex i; corners come first. `key` spells everything out.
struct CanonicalForm {
  std::vector<int> vertices;
  std::vector<int> key;
};
CanonicalForm canonical_form(const Neighbourhood& neighbourhood);

/// The neighbourhood in these numbers. (Few that are met are new, so most need no copy.)
Neighbourhood in_canonical_numbers(const Neighbourhood& neighbourhood);

}  // namespace shaolin
