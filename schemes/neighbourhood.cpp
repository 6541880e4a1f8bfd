#include "neighbourhood.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <iterator>
#include <optional>
#include <unordered_map>

#include "numbering.h"
#include "sharpness.h"

namespace shaolin {

namespace {

/// The ring's sector from spoke `first` over `faces` faces, open.
Ring sector(const Ring& ring, int first, int faces) {
  Ring result;
  result.vertex = ring.vertex;
  result.closed = false;
  result.sharpness = ring.sharpness;
  result.cone = ring.cone;
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
    if (ring.faces[i].id() == face.id() && ring.faces[i].side(0) == face.side(static_cast<int>(k)))
      return static_cast<int>(i);
  assert(false && "a corner's ring holds the corner's face");
  return 0;
}

namespace {

/// The sector of a ring that holds the face in that place, if infinitely sharp edges cut it out for good: not while
/// semi-sharp edges still count for the vertex's rule. A sector of three or more sharp edges ends at a corner.
std::optional<Ring> cut_sector(const Ring& ring, int place) {
  const std::vector<float> sharpness = ring.spoke_sharpness();
  if (std::any_of(sharpness.begin(), sharpness.end(), is_semi_sharp)) return {};
  const auto infinite = std::count_if(sharpness.begin(), sharpness.end(), is_infinite);
  if (infinite < 2) return {};
  Ring cut = sector_of_face(ring, place);
  if (infinite > 2) cut.sharpness = infinite_sharpness;
  return cut;
}

bool has_face(const Ring& ring, int id) {
  return std::any_of(ring.faces.begin(), ring.faces.end(), [&](const FaceSides& face) { return face.id() == id; });
}

/// Calls visit(face) for the faces of the corners' rings that have the vertex.
template <class Visit>
void each_near_face(const std::vector<const Ring*>& corners, int vertex, Visit visit) {
  for (const Ring* ring : corners)
    for (const FaceSides& face : ring->faces)
      if (face.has_vertex(vertex)) visit(face);
}

/// Radius 2: a sector is cut out only if all faces around the corners that have its vertex lie in it, for edge points
/// beyond read the whole ring. Then rings that no face around the corners leads to are left out.
void drop_beyond_second_rings(Neighbourhood& neighbourhood, std::vector<std::optional<Ring>> cuts) {
  std::vector<Ring>& rings = neighbourhood.rings;
  const auto size = static_cast<std::size_t>(neighbourhood.face.size());
  const auto corners = [&] {
    std::vector<const Ring*> result;
    for (std::size_t k = 0; k < size; ++k) result.push_back(cuts[k] ? &*cuts[k] : &rings[k]);
    return result;
  };
  for (bool settled = false; !settled;) {
    settled = true;
    for (std::size_t k = 0; k < size; ++k) {
      if (!cuts[k]) continue;
      bool whole = false;
      each_near_face(corners(), rings[k].vertex,
                     [&](const FaceSides& face) { whole |= !has_face(*cuts[k], face.id()); });
      if (!whole) continue;
      cuts[k].reset();
      settled = false;
    }
  }
  for (std::size_t k = 0; k < size; ++k)
    if (cuts[k]) rings[k] = std::move(*cuts[k]);

  std::vector<const Ring*> kept;
  for (std::size_t k = 0; k < size; ++k) kept.push_back(&rings[k]);
  std::vector<Ring> near;
  for (std::size_t i = size; i < rings.size(); ++i) {
    const FaceSides* first = nullptr;
    each_near_face(kept, rings[i].vertex, [&](const FaceSides& face) { first = first ? first : &face; });
    if (!first) continue;
    int place = 0;
    while (rings[i].faces[static_cast<std::size_t>(place)].id() != first->id()) ++place;
    std::optional<Ring> cut = cut_sector(rings[i], place);
    bool whole = !cut;
    each_near_face(kept, rings[i].vertex, [&](const FaceSides& face) { whole |= cut && !has_face(*cut, face.id()); });
    near.push_back(whole ? std::move(rings[i]) : std::move(*cut));
  }
  rings.resize(size);
  std::move(near.begin(), near.end(), std::back_inserter(rings));
}

}  // namespace

void drop_beyond_creases(Neighbourhood& neighbourhood) {
  const FaceSides& face = neighbourhood.face;
  std::unordered_map<int, int> repeats;
  for (int k = 0; k < face.size(); ++k) ++repeats[face.vertex(k)];
  std::vector<std::optional<Ring>> cuts(static_cast<std::size_t>(face.size()));
  for (int k = 0; k < face.size(); ++k) {
    // Corners of a vertex that the face repeats keep their rings, so that children beside each other share theirs.
    if (repeats[face.vertex(k)] > 1) continue;
    const auto at = static_cast<std::size_t>(k);
    cuts[at] = cut_sector(neighbourhood.rings[at], place_of_face(neighbourhood, at));
  }
  if (neighbourhood.rings.size() > cuts.size()) return drop_beyond_second_rings(neighbourhood, std::move(cuts));
  for (std::size_t k = 0; k < cuts.size(); ++k)
    if (cuts[k]) neighbourhood.rings[k] = std::move(*cuts[k]);
}

namespace {

/// Turns a closed ring so that the face in that place comes first.
void turn(Ring& ring, int place) {
  if (!ring.closed) return;
  std::rotate(ring.spokes.begin(), ring.spokes.begin() + place, ring.spokes.end());
  std::rotate(ring.faces.begin(), ring.faces.begin() + place, ring.faces.end());
}

}  // namespace

void turn_to_face(Neighbourhood& neighbourhood) {
  std::vector<Ring>& rings = neighbourhood.rings;
  const auto corners = static_cast<std::size_t>(neighbourhood.face.size());
  for (std::size_t k = 0; k < corners; ++k)
    if (rings[k].closed) turn(rings[k], place_of_face(neighbourhood, k));

  std::unordered_map<int, std::size_t> outer;
  for (std::size_t i = corners; i < rings.size(); ++i) outer.emplace(rings[i].vertex, i);
  std::vector<Ring> met;
  for (std::size_t k = 0; k < corners && !outer.empty(); ++k)
    for (const FaceSides& face : rings[k].faces)
      for (int i = 0; i < face.size(); ++i) {
        const auto at = outer.find(face.vertex(i));
        if (at == outer.end()) continue;
        Ring& ring = met.emplace_back(std::move(rings[at->second]));
        outer.erase(at);
        const auto same = std::find_if(ring.faces.begin(), ring.faces.end(),
                                       [&](const FaceSides& other) { return other.id() == face.id(); });
        turn(ring, static_cast<int>(same - ring.faces.begin()));
      }
  rings.resize(corners);
  std::move(met.begin(), met.end(), std::back_inserter(rings));
}

namespace {

/// The walk that numbers vertices, edges and faces as it meets them, writes the key and, if asked to, a copy in the new
/// numbers. Its own lists live in one buffer, for they are many and short-lived.
class CanonicalWalk {
 public:
  explicit CanonicalWalk(bool copies) : copies_(copies) {
    constexpr std::size_t most = 512;  // of a regular face, some 240 words
    key.reserve(most);
    vertices.reserve(most / 8);
    faces_.reserve(most / 8);
  }

  void over(const Neighbourhood& neighbourhood);

  std::vector<int> vertices, key;
  Neighbourhood copy;

 private:
  struct Known {
    FaceSides original, copy;
  };
  int vertex(int old) {
    const int number = vertex_numbers_({old});
    if (number == static_cast<int>(vertices.size())) vertices.push_back(old);
    return number;
  }
  int edge(int old) { return edge_numbers_({old}); }
  void add_sharpness(float value) { key.push_back(std::bit_cast<int>(value)); }
  FaceSides face(const FaceSides& old);
  void ring(const Ring& old);

  bool copies_;
  Numbering<1> vertex_numbers_, edge_numbers_, face_numbers_;
  std::vector<Known> faces_;  ///< by number
};

/// The face in the new numbers; empty without copies.
FaceSides CanonicalWalk::face(const FaceSides& old) {
  const int id = face_numbers_({old.id()}), size = old.size();
  if (id < static_cast<int>(faces_.size())) {
    const Known& known = faces_[static_cast<std::size_t>(id)];
    const int turn = known.original.turn_to(old);
    key.push_back(id);
    key.push_back(turn);
    return copies_ ? known.copy.turned(turn) : FaceSides();
  }
  key.push_back(id);
  key.push_back(size);
  const std::size_t first = key.size();
  for (int i = 0; i < size; ++i) key.push_back(vertex(old.vertex(i)));
  for (int i = 0; i < size; ++i) key.push_back(edge(old.side(i)));
  Known& known = faces_.emplace_back(Known{old, {}});
  if (!copies_) return {};
  const std::vector<int>& list = copy.lists.emplace_back(key.begin() + static_cast<std::ptrdiff_t>(first), key.end());
  return known.copy = FaceSides(id, list.data(), list.data() + size, size);
}

void CanonicalWalk::ring(const Ring& old) {
  const int centre = vertex(old.vertex);
  key.insert(key.end(), {centre, old.closed + 2 * old.cone, static_cast<int>(old.spokes.size())});
  add_sharpness(old.sharpness);
  Ring renamed;
  for (const FaceSides& of : old.faces) {
    const FaceSides here = face(of);
    if (copies_) renamed.faces.push_back(here);
  }
  for (const Ring::Spoke& spoke : old.spokes) {
    const int end = vertex(spoke.end), its_edge = edge(spoke.edge);
    if (copies_) {
      renamed.spokes.push_back(spoke);
      renamed.spokes.back().end = end;
      renamed.spokes.back().edge = its_edge;
    }
    add_sharpness(spoke.sharpness);
    if (!is_semi_sharp(spoke.sharpness)) continue;  // then the halves follow from it
    add_sharpness(spoke.near_half);
    add_sharpness(spoke.far_half);
  }
  if (!copies_) return;
  renamed.vertex = centre;
  renamed.closed = old.closed;
  renamed.sharpness = old.sharpness;
  renamed.cone = old.cone;
  copy.rings.push_back(std::move(renamed));
}

void CanonicalWalk::over(const Neighbourhood& neighbourhood) {
  copy.face = face(neighbourhood.face);
  for (const Ring& old : neighbourhood.rings) ring(old);
}

}  // namespace

CanonicalForm canonical_form(const Neighbourhood& neighbourhood) {
  CanonicalWalk walk(false);
  walk.over(neighbourhood);
  return {std::move(walk.vertices), std::move(walk.key)};
}

Neighbourhood in_canonical_numbers(const Neighbourhood& neighbourhood) {
  CanonicalWalk walk(true);
  walk.over(neighbourhood);
  return std::move(walk.copy);
}

}  // namespace shaolin
