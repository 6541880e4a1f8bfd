#include "refinement.h"

#include <algorithm>

namespace shaolin {

namespace {

/// The face, seen from the vertex `first`.
FaceSides seen_from_vertex(const FaceSides& face, int first) {
  int at = 0;
  while (face.vertex(at) != first) ++at;
  return face.turned(at);
}

}  // namespace

Refinement::Refinement(const Neighbourhood& parent, FaceKind kind, CreaseMethod creases)
    : parent_(parent), kind_(kind), creases_(creases) {
  for (const Ring& ring : parent.rings) {
    rings_.try_emplace(ring.vertex, &ring);
    for (const FaceSides& face : ring.faces) faces_.try_emplace(face.id(), face);
  }
}

int Refinement::child_count() const { return kind_ == FaceKind::triangle ? 4 : parent_.face.size(); }

int Refinement::vertex(const RefinedVertex& from) {
  const int number = numbers_({static_cast<int>(from.kind), from.id});
  if (number == static_cast<int>(vertices_.size())) vertices_.push_back(from);
  return number;
}

/// The next level's face of that identifier, whose vertices and sides `lists` tells if it is new; they are kept once.
template <class Lists>
FaceSides Refinement::made(int id, int size, Lists lists) {
  if (static_cast<std::size_t>(id) == children_.size()) {
    const std::array<int, 8>& kept = lists_.emplace_back(lists());
    children_.emplace_back(id, kept.data(), kept.data() + 4, size);
  }
  return children_[static_cast<std::size_t>(id)];
}

/// The child of `parent` at its corner in place `at`, seen from the refined vertex `first`.
FaceSides Refinement::corner_face(const FaceSides& parent, int at, int first) {
  const int size = parent.size(), leaving = parent.side(at), entering = parent.side((at + size - 1) % size);
  const int corner = parent.vertex(at);
  const int id = face_ids_({0, parent.id(), leaving});
  const auto quad = [&]() -> std::array<int, 8> {
    return {from_vertex(corner),   from_edge(leaving),          from_face(parent.id()),       from_edge(entering),
            half(leaving, corner), inner(parent.id(), leaving), inner(parent.id(), entering), half(entering, corner)};
  };
  const auto triangle = [&]() -> std::array<int, 8> {
    const int opposite = parent.side((at + 1) % 3);
    return {from_vertex(corner),   from_edge(leaving),           from_edge(entering),    0,
            half(leaving, corner), inner(parent.id(), opposite), half(entering, corner), 0};
  };
  return seen_from_vertex(kind_ == FaceKind::quad ? made(id, 4, quad) : made(id, 3, triangle), first);
}

/// The middle child of a triangle, seen from the refined vertex `first`. The edge between the midpoints of two sides
/// runs along the third.
FaceSides Refinement::middle_face(const FaceSides& parent, int first) {
  const int id = parent.id(), a = parent.side(0), b = parent.side(1), c = parent.side(2);
  const auto middle = [&]() -> std::array<int, 8> {
    return {from_edge(b), from_edge(c), from_edge(a), 0, inner(id, a), inner(id, b), inner(id, c), 0};
  };
  return seen_from_vertex(made(face_ids_({1, id, 0}), 3, middle), first);
}

FaceSides Refinement::child_face(int k) {
  const FaceSides& face = parent_.face;
  if (kind_ == FaceKind::triangle && k == 3) return middle_face(face, from_edge(face.side(1)));
  const bool keeps_orientation = kind_ == FaceKind::triangle || face.size() == 4;
  const FaceSides child = corner_face(face, k, from_vertex(face.vertex(k)));
  return keeps_orientation ? child.turned((child.size() - k) % child.size()) : child;
}

Neighbourhood Refinement::child(int k, int radius) {
  // A vertex that the face repeats has a ring for each of its corners; other children see the first of them.
  const bool has_corner = k < parent_.face.size();
  const Ring*& at_corner = rings_[parent_.face.vertex(has_corner ? k : 0)];
  const Ring* const first = at_corner;
  if (has_corner) at_corner = &parent_.rings[static_cast<std::size_t>(k)];
  Neighbourhood result;
  result.face = child_face(k);
  std::vector<int> inner;
  for (int i = 0; i < result.face.size(); ++i) inner.push_back(result.face.vertex(i));
  for (std::size_t done = 0; radius > 0; --radius) {
    const std::size_t end = inner.size();
    for (; done < end; ++done) {
      result.rings.push_back(ring(inner[done]));
      if (radius == 1) continue;
      for (const FaceSides& face : result.rings.back().faces)
        for (int i = 0; i < face.size(); ++i)
          if (std::find(inner.begin(), inner.end(), face.vertex(i)) == inner.end()) inner.push_back(face.vertex(i));
    }
  }
  at_corner = first;
  return result;
}

Ring Refinement::ring(int refined) {
  const RefinedVertex from = vertices_[static_cast<std::size_t>(refined)];
  switch (from.kind) {
    case RefinedVertex::Kind::vertex:
      return ring_of_vertex(from.id);
    case RefinedVertex::Kind::edge:
      return ring_of_edge(from.id);
    default:
      return ring_of_face(faces_.at(from.id));
  }
}

/// The halves at a vertex of the edges around it.
SemiSharpEdges Refinement::halves_around(int v) const {
  SemiSharpEdges halves(creases_);
  for (const Ring::Spoke& spoke : rings_.at(v)->spokes) halves.add(spoke.near_half);
  return halves;
}

Ring Refinement::ring_of_vertex(int v) {
  const Ring& parent = *rings_.at(v);
  Ring result;
  result.vertex = from_vertex(v);
  result.closed = parent.closed;
  result.sharpness = decayed(parent.sharpness);
  result.cone = parent.cone;
  result.spokes.reserve(parent.spokes.size());
  result.faces.reserve(parent.faces.size());
  const SemiSharpEdges here = halves_around(v);
  for (const Ring::Spoke& spoke : parent.spokes) {
    SemiSharpEdges there(creases_);  // the edge's two halves meet at its new vertex
    there.add(spoke.near_half);
    there.add(spoke.far_half);
    result.spokes.push_back({from_edge(spoke.edge), half(spoke.edge, v), spoke.near_half, here.decayed(spoke.near_half),
                             there.decayed(spoke.near_half)});
  }
  for (const FaceSides& face : parent.faces) result.faces.push_back(corner_face(face, 0, result.vertex));
  return result;
}

/// The edge as a spoke that has the face itself beside it, if there is one, and what lies beyond the edge, too, if any
/// ring holds it (the ring of a dart does); else at the end of a ring that was cut there, if there is one.
Refinement::Place Refinement::place_of_edge(int edge) const {
  Place place{nullptr, 0, nullptr, nullptr}, cut = place, one_sided = place;
  for (const Ring& ring : parent_.rings) {
    for (std::size_t i = 0; i < ring.spokes.size(); ++i) {
      if (ring.spokes[i].edge != edge) continue;
      place = {&ring, i, i < ring.faces.size() ? &ring.faces[i] : nullptr,
               i > 0         ? &ring.faces[i - 1]
               : ring.closed ? &ring.faces.back()
                             : nullptr};
      const auto is_face = [&](const FaceSides* side) { return side && side->id() == parent_.face.id(); };
      if (is_face(place.left) || is_face(place.right)) {
        if (place.left && place.right) return place;
        one_sided = place;
      }
      if (!place.left || !place.right) cut = place;
    }
  }
  return one_sided.ring ? one_sided : cut.ring ? cut : place;
}

/// Around an edge's new vertex: the two halves of the edge, and what each side's face contributes between them. A side
/// beyond an infinitely sharp edge is there if a ring holds it: around a dart it is read by masks of radius 2.
Ring Refinement::ring_of_edge(int edge) {
  const Place place = place_of_edge(edge);
  const Ring::Spoke& spoke = place.ring->spokes[place.spoke];
  const int a = place.ring->vertex, b = spoke.end;
  Ring result;
  result.vertex = from_edge(edge);
  result.closed = place.left && place.right;
  result.spokes.reserve(6);
  result.faces.reserve(6);
  result.sharpness = a == b ? infinite_sharpness : 0;  // an edge between equal vertices is a point
  SemiSharpEdges here(creases_);
  here.add(spoke.near_half);
  here.add(spoke.far_half);
  const auto towards = [&](int end, float sharpness) -> Ring::Spoke {
    const float far_half = is_semi_sharp(sharpness) ? halves_around(end).decayed(sharpness) : sharpness;
    return {from_vertex(end), half(edge, end), sharpness, here.decayed(sharpness), far_half};
  };
  const Ring::Spoke towards_a = towards(a, spoke.near_half), towards_b = towards(b, spoke.far_half);
  if (place.left) {
    result.spokes.push_back(towards_b);
    add_side(result, *place.left, 0);
    if (!place.right) result.spokes.push_back(towards_a);
  }
  if (place.right) {
    result.spokes.push_back(towards_a);
    add_side(result, *place.right, place.right->size() - 1);
    if (!place.left) result.spokes.push_back(towards_b);
  }
  return result;
}

/// The faces and inner spokes on the side of `face`, whose side in place `at` carries the ring's vertex: from the half
/// towards the side's second vertex around to the half towards its first.
void Refinement::add_side(Ring& ring, const FaceSides& face, int at) {
  const int second = (at + 1) % face.size();
  ring.faces.push_back(corner_face(face, second, ring.vertex));
  if (kind_ == FaceKind::triangle) {
    const int after = face.side(second), before = face.side((at + 2) % 3);
    ring.spokes.push_back({from_edge(after), inner(face.id(), before), 0});
    ring.faces.push_back(middle_face(face, ring.vertex));
    ring.spokes.push_back({from_edge(before), inner(face.id(), after), 0});
  } else {
    ring.spokes.push_back({from_face(face.id()), inner(face.id(), face.side(at)), 0});
  }
  ring.faces.push_back(corner_face(face, at, ring.vertex));
}

Ring Refinement::ring_of_face(const FaceSides& face) {
  Ring result;
  result.vertex = from_face(face.id());
  result.spokes.reserve(static_cast<std::size_t>(face.size()));
  result.faces.reserve(static_cast<std::size_t>(face.size()));
  for (int k = 0; k < face.size(); ++k) {
    result.spokes.push_back({from_edge(face.side(k)), inner(face.id(), face.side(k)), 0});
    result.faces.push_back(corner_face(face, (k + 1) % face.size(), result.vertex));
  }
  return result;
}

}  // namespace shaolin
