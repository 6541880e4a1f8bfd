#include "neighbourhood.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <unordered_map>

#include "sharpness.h"

namespace shaolin {

namespace {

std::vector<int> turned(const std::vector<int>& values, std::size_t at) {
  std::vector<int> result(values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  result.insert(result.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at));
  return result;
}

/// The face, turned to begin at place `at`.
void turn(FaceSides& face, std::size_t at) {
  face.vertices = turned(face.vertices, at);
  face.sides = turned(face.sides, at);
}

/// The face, turned to begin at the vertex `first`.
void turn_to_vertex(FaceSides& face, int first) {
  const auto at = std::find(face.vertices.begin(), face.vertices.end(), first);
  turn(face, static_cast<std::size_t>(at - face.vertices.begin()));
}

/// The ring's sector from spoke `first` over `faces` faces, open.
Ring sector(const Ring& ring, int first, int faces) {
  Ring result;
  result.vertex = ring.vertex;
  result.closed = false;
  result.sharpness = ring.sharpness;
  const auto spokes = ring.spokes.size();
  for (int i = 0; i <= faces; ++i) result.spokes.push_back(ring.spokes[static_cast<std::size_t>(first + i) % spokes]);
  for (int i = 0; i < faces; ++i)
    result.faces.push_back(ring.faces[static_cast<std::size_t>(first + i) % ring.faces.size()]);
  return result;
}

/// The sector of `ring` between infinitely sharp edges that holds the face at `place`.
Ring sector_of_face(const Ring& ring, int place) {
  const int spokes = static_cast<int>(ring.spokes.size());
  const auto infinite = [&](int i) {
    return is_infinite(ring.spokes[static_cast<std::size_t>((i % spokes + spokes) % spokes)].sharpness);
  };
  int first = place;
  int end = place + 1;
  while (!infinite(first)) --first;
  while (!infinite(end)) ++end;
  return sector(ring, (first + spokes) % spokes, end - first);
}

}  // namespace

int place_of_face(const Neighbourhood& neighbourhood, std::size_t k) {
  const Ring& ring = neighbourhood.rings[k];
  const FaceSides& face = neighbourhood.face;
  for (std::size_t i = 0; i < ring.faces.size(); ++i)
    if (ring.faces[i].id == face.id && ring.faces[i].sides[0] == face.sides[k]) return static_cast<int>(i);
  assert(false && "a corner's ring holds the corner's face");
  return 0;
}

void drop_beyond_creases(Neighbourhood& neighbourhood) {
  const std::vector<int>& corners = neighbourhood.face.vertices;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    // A vertex that the face repeats has one ring for all its corners, so that their children share their rings.
    if (std::count(corners.begin(), corners.end(), corners[k]) > 1) continue;
    Ring& ring = neighbourhood.rings[k];
    const std::vector<float> sharpness = ring.spoke_sharpness();
    if (std::any_of(sharpness.begin(), sharpness.end(), is_semi_sharp)) continue;
    const auto infinite = std::count_if(sharpness.begin(), sharpness.end(), is_infinite);
    if (infinite < 2) continue;
    const int place = place_of_face(neighbourhood, k);
    ring = sector_of_face(ring, place);
    if (infinite > 2) ring.sharpness = infinite_sharpness;
  }
}

void turn_to_face(Neighbourhood& neighbourhood) {
  for (std::size_t k = 0; k < neighbourhood.face.vertices.size(); ++k) {
    Ring& ring = neighbourhood.rings[k];
    if (!ring.closed) continue;
    const int place = place_of_face(neighbourhood, k);
    std::rotate(ring.spokes.begin(), ring.spokes.begin() + place, ring.spokes.end());
    std::rotate(ring.faces.begin(), ring.faces.begin() + place, ring.faces.end());
  }
}

CanonicalForm canonical_form(const Neighbourhood& neighbourhood) {
  CanonicalForm result;
  std::unordered_map<int, int> vertex_numbers, edge_numbers, face_numbers;
  const auto number_of = [&](int vertex) {
    const auto [at, is_new] = vertex_numbers.try_emplace(vertex, static_cast<int>(result.vertices.size()));
    if (is_new) result.vertices.push_back(vertex);
    return at->second;
  };
  const auto edge_number = [&](int edge) {
    return edge_numbers.try_emplace(edge, static_cast<int>(edge_numbers.size())).first->second;
  };
  const auto renumbered = [&](const FaceSides& face) {
    FaceSides copy{face_numbers.try_emplace(face.id, static_cast<int>(face_numbers.size())).first->second, {}, {}};
    for (const int vertex : face.vertices) copy.vertices.push_back(number_of(vertex));
    for (const int edge : face.sides) copy.sides.push_back(edge_number(edge));
    result.key.push_back(copy.id);
    result.key.push_back(static_cast<int>(copy.vertices.size()));
    result.key.insert(result.key.end(), copy.vertices.begin(), copy.vertices.end());
    result.key.insert(result.key.end(), copy.sides.begin(), copy.sides.end());
    return copy;
  };
  const auto add_sharpness = [&](float value) { result.key.push_back(std::bit_cast<int>(value)); };

  result.neighbourhood.face = renumbered(neighbourhood.face);
  for (const Ring& ring : neighbourhood.rings) {
    Ring copy;
    copy.vertex = number_of(ring.vertex);
    copy.closed = ring.closed;
    copy.sharpness = ring.sharpness;
    result.key.insert(result.key.end(), {copy.vertex, copy.closed, static_cast<int>(ring.spokes.size())});
    add_sharpness(ring.sharpness);
    for (const FaceSides& face : ring.faces) copy.faces.push_back(renumbered(face));
    for (const Ring::Spoke& spoke : ring.spokes) {
      copy.spokes.push_back({number_of(spoke.end), edge_number(spoke.edge), spoke.sharpness});
      add_sharpness(spoke.sharpness);
    }
    result.neighbourhood.rings.push_back(std::move(copy));
  }
  return result;
}

Refinement::Refinement(const Neighbourhood& parent, FaceKind kind) : parent_(parent), kind_(kind) {
  for (const Ring& ring : parent.rings) {
    rings_.try_emplace(ring.vertex, &ring);
    for (const FaceSides& face : ring.faces) faces_.try_emplace(face.id, &face);
  }
}

int Refinement::child_count() const {
  return kind_ == FaceKind::triangle ? 4 : static_cast<int>(parent_.face.vertices.size());
}

int Refinement::vertex(const RefinedVertex& from) {
  const auto [at, is_new] = numbers_.try_emplace(from, static_cast<int>(vertices_.size()));
  if (is_new) vertices_.push_back(from);
  return at->second;
}

/// The child of `parent` at its corner in place `at`, turned to begin at the refined vertex `first`.
FaceSides Refinement::corner_face(const FaceSides& parent, std::size_t at, int first) {
  const std::size_t size = parent.vertices.size(), last = (at + size - 1) % size;
  const int corner = parent.vertices[at], leaving = parent.sides[at], entering = parent.sides[last];
  FaceSides child{named(face_ids_, {0, parent.id, leaving}), {from_vertex(corner), from_edge(leaving)}, {}};
  child.sides.push_back(half(leaving, corner));
  if (kind_ == FaceKind::quad) {
    child.vertices.push_back(from_face(parent.id));
    child.sides.push_back(inner(parent.id, leaving));
    child.sides.push_back(inner(parent.id, entering));
  } else {
    child.sides.push_back(inner(parent.id, parent.sides[(at + 1) % 3]));
  }
  child.vertices.push_back(from_edge(entering));
  child.sides.push_back(half(entering, corner));
  turn_to_vertex(child, first);
  return child;
}

/// The middle child of a triangle, turned to begin at the refined vertex `first`. The edge between the midpoints of two
/// sides runs along the third.
FaceSides Refinement::middle_face(const FaceSides& parent, int first) {
  const std::vector<int>& s = parent.sides;
  FaceSides child{named(face_ids_, {1, parent.id, 0}),
                  {from_edge(s[1]), from_edge(s[2]), from_edge(s[0])},
                  {inner(parent.id, s[0]), inner(parent.id, s[1]), inner(parent.id, s[2])}};
  turn_to_vertex(child, first);
  return child;
}

FaceSides Refinement::child_face(int k) {
  const FaceSides& face = parent_.face;
  if (kind_ == FaceKind::triangle && k == 3) return middle_face(face, from_edge(face.sides[1]));
  const auto at = static_cast<std::size_t>(k);
  const bool keeps_orientation = kind_ == FaceKind::triangle || face.vertices.size() == 4;
  FaceSides child = corner_face(face, at, from_vertex(face.vertices[at]));
  if (keeps_orientation) turn(child, (child.vertices.size() - at) % child.vertices.size());
  return child;
}

Neighbourhood Refinement::child(int k, int radius) {
  Neighbourhood result;
  result.face = child_face(k);
  std::vector<int> inner = result.face.vertices;
  for (std::size_t done = 0; radius > 0; --radius) {
    const std::size_t end = inner.size();
    for (; done < end; ++done) {
      result.rings.push_back(ring(inner[done]));
      for (const FaceSides& face : result.rings.back().faces)
        for (const int v : face.vertices)
          if (radius > 1 && std::find(inner.begin(), inner.end(), v) == inner.end()) inner.push_back(v);
    }
  }
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
      return ring_of_face(*faces_.at(from.id));
  }
}

Ring Refinement::ring_of_vertex(int v) {
  const Ring& parent = *rings_.at(v);
  Ring result;
  result.vertex = from_vertex(v);
  result.closed = parent.closed;
  result.sharpness = decayed(parent.sharpness);
  for (const Ring::Spoke& spoke : parent.spokes)
    result.spokes.push_back({from_edge(spoke.edge), half(spoke.edge, v), decayed(spoke.sharpness)});
  for (const FaceSides& face : parent.faces) result.faces.push_back(corner_face(face, 0, result.vertex));
  return result;
}

/// The edge as a spoke that has the face itself beside it, if there is one.
Refinement::Place Refinement::place_of_edge(int edge) const {
  Place place{nullptr, 0, nullptr, nullptr};
  for (const Ring& ring : parent_.rings) {
    for (std::size_t i = 0; i < ring.spokes.size(); ++i) {
      if (ring.spokes[i].edge != edge) continue;
      place = {&ring, i, i < ring.faces.size() ? &ring.faces[i] : nullptr,
               i > 0         ? &ring.faces[i - 1]
               : ring.closed ? &ring.faces.back()
                             : nullptr};
      const auto is_face = [&](const FaceSides* side) { return side && side->id == parent_.face.id; };
      if (is_face(place.left) || is_face(place.right)) return place;
    }
  }
  return place;
}

/// Around an edge's new vertex: the two halves of the edge, and what each side's face contributes between them. A side
/// beyond an infinitely sharp edge of the face itself is left out.
Ring Refinement::ring_of_edge(int edge) {
  Place place = place_of_edge(edge);
  const Ring::Spoke& spoke = place.ring->spokes[place.spoke];
  const int a = place.ring->vertex, b = spoke.end;
  if (is_infinite(spoke.sharpness)) {
    if (place.left && place.left->id == parent_.face.id) {
      place.right = nullptr;
    } else if (place.right && place.right->id == parent_.face.id) {
      place.left = nullptr;
    }
  }

  Ring result;
  result.vertex = from_edge(edge);
  result.closed = place.left && place.right;
  result.sharpness = a == b ? infinite_sharpness : 0;  // an edge between equal vertices is a point
  const float sharpness = decayed(spoke.sharpness);
  const Ring::Spoke towards_a{from_vertex(a), half(edge, a), sharpness};
  const Ring::Spoke towards_b{from_vertex(b), half(edge, b), sharpness};
  if (place.left) {
    result.spokes.push_back(towards_b);
    add_side(result, *place.left, 0);
    if (!place.right) result.spokes.push_back(towards_a);
  }
  if (place.right) {
    result.spokes.push_back(towards_a);
    add_side(result, *place.right, place.right->vertices.size() - 1);
    if (!place.left) result.spokes.push_back(towards_b);
  }
  return result;
}

/// The faces and inner spokes on the side of `face`, whose side in place `at` carries the ring's vertex: from the half
/// towards the side's second vertex around to the half towards its first.
void Refinement::add_side(Ring& ring, const FaceSides& face, std::size_t at) {
  const std::size_t size = face.vertices.size(), second = (at + 1) % size;
  ring.faces.push_back(corner_face(face, second, ring.vertex));
  if (kind_ == FaceKind::triangle) {
    const int after = face.sides[second], before = face.sides[(at + 2) % 3];
    ring.spokes.push_back({from_edge(after), inner(face.id, before), 0});
    ring.faces.push_back(middle_face(face, ring.vertex));
    ring.spokes.push_back({from_edge(before), inner(face.id, after), 0});
  } else {
    ring.spokes.push_back({from_face(face.id), inner(face.id, face.sides[at]), 0});
  }
  ring.faces.push_back(corner_face(face, at, ring.vertex));
}

Ring Refinement::ring_of_face(const FaceSides& face) {
  Ring result;
  result.vertex = from_face(face.id);
  for (std::size_t k = 0; k < face.vertices.size(); ++k) {
    result.spokes.push_back({from_edge(face.sides[k]), inner(face.id, face.sides[k]), 0});
    result.faces.push_back(corner_face(face, (k + 1) % face.vertices.size(), result.vertex));
  }
  return result;
}

}  // namespace shaolin
