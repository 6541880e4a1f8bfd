#include "plain_face.h"

#include "numbering.h"

namespace shaolin {

namespace {

/// How many vertices the faces around a face's corners have if none stands in two places, by the sum of the corners'
/// valences: of quads a ring of n has 2 n + 1. The face's corners stand in four rings each, the two vertices beyond
/// each side in two: 8 n / 4 + 4 - 12 - 8. Of triangles n + 1; corners stand in three, the vertex beyond each side in
/// two.
int vertices_around(FaceKind kind, int valences) {
  return kind == FaceKind::quad ? 2 * valences + 4 - 12 - 8 : valences + 3 - 6 - 3;
}

}  // namespace

std::optional<PlainFace> plain_face(const Mesh& mesh, Mesh::Corner corner) {
  constexpr int least_valence = 3, most_valence = 15;
  const FaceKind kind = mesh.face_kind();
  const int corners = kind == FaceKind::quad ? 4 : 3;
  const HalfEdges& half_edges = mesh.half_edges();
  if (mesh.face_size(corner.face) != corners) return {};
  const int first = half_edges.first(corner.face);
  std::array<int, 4> rings{};  // a corner of each ring: the face's own
  for (int k = 0; k < corners; ++k) {
    const int own = first + (corner.place + k) % corners;
    if (!mesh.is_plain(half_edges.from(own))) return {};
    rings[static_cast<std::size_t>(k)] = own;
  }

  Numbering<1> numbers;
  const auto number_face = [&](int from) {
    for (int i = 0, at = from; i < corners; ++i, at = half_edges.next(at)) numbers({half_edges.from(at)});
  };
  number_face(rings[0]);
  std::array<int, 4> valences{};
  int sum = 0;
  for (int k = 0; k < corners; ++k) {
    const int own = rings[static_cast<std::size_t>(k)];
    int& valence = valences[static_cast<std::size_t>(k)];
    for (int at = own; valence == 0 || at != own; at = half_edges.counter_clockwise(at)) {
      if (at < 0 || mesh.face_size(half_edges.face(at)) != corners || ++valence > most_valence) return {};
      number_face(at);
    }
    if (valence < least_valence) return {};
    sum += valence;
  }
  if (numbers.size() != vertices_around(kind, sum)) return {};

  PlainFace result{valences, {}};
  result.vertices.reserve(numbers.names().size());
  for (const auto& [vertex] : numbers.names()) result.vertices.push_back(vertex);
  return result;
}

}  // namespace shaolin
