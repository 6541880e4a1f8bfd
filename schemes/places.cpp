#include "places.h"

#include <optional>

#include "mesh.h"

namespace shaolin {

namespace {

bool is_split_by_corner(const Mesh& mesh, int face) {
  return mesh.face_size(face) != (mesh.face_kind() == FaceKind::quad ? 4 : 3);
}

/// A place of a side, by the half-edge: 0 where it begins, 1 where it ends.
struct SidePlace {
  int side;
  double along;
};

/// Empty for places inside of their face. Of corners, the side that begins there. Of an n-gon's quad, u runs along the
/// first half of the corner's own side, v back along the second half of the one before.
std::optional<SidePlace> side_place(const Mesh& mesh, const SurfaceParameter& at) {
  const int first = mesh.half_edges().first(at.face);
  if (is_split_by_corner(mesh, at.face)) {
    const int own = first + at.sub;
    if (at.v == 0) return SidePlace{own, 0.5 * at.u};
    if (at.u == 0) return SidePlace{mesh.half_edges().previous(own), 1 - 0.5 * at.v};
    return {};
  }
  if (at.v == 0 && at.u < 1) return SidePlace{first, at.u};
  if (mesh.face_kind() == FaceKind::triangle) {
    if (at.u + at.v == 1 && at.v < 1) return SidePlace{first + 1, at.v};
    if (at.u == 0) return SidePlace{first + 2, 1 - at.v};
    return {};
  }
  if (at.u == 1 && at.v < 1) return SidePlace{first + 1, at.v};
  if (at.v == 1 && at.u > 0) return SidePlace{first + 2, 1 - at.u};
  if (at.u == 0) return SidePlace{first + 3, 1 - at.v};
  return {};
}

/// The reverse: one place, or of an n-gon's side the middle of which two quads share, two.
void add_places(const Mesh& mesh, const SidePlace& at, std::vector<SurfaceParameter>& places) {
  const HalfEdges& half_edges = mesh.half_edges();
  const int face = half_edges.face(at.side), place = half_edges.place(at.side);
  const double along = at.along, left = 1 - along;
  if (is_split_by_corner(mesh, face)) {
    if (along <= 0.5) places.push_back({face, place, 2 * along, 0});
    if (along >= 0.5) places.push_back({face, (place + 1) % mesh.face_size(face), 0, 2 * left});
  } else if (place == 0) {
    places.push_back({face, 0, along, 0});
  } else if (mesh.face_kind() == FaceKind::triangle) {
    places.push_back(place == 1 ? SurfaceParameter{face, 0, left, along} : SurfaceParameter{face, 0, 0, left});
  } else {
    places.push_back(place == 1   ? SurfaceParameter{face, 0, 1, along}
                     : place == 2 ? SurfaceParameter{face, 0, left, 1}
                                  : SurfaceParameter{face, 0, 0, left});
  }
}

PointPlaces around_vertex(const Mesh& mesh, int corner) {
  const HalfEdges& half_edges = mesh.half_edges();
  PointPlaces result{{}, true};
  const auto add = [&](int at) {
    if (mesh.has_limit(half_edges.face(at)))
      add_places(mesh, {at, 0}, result.all);
    else
      result.is_closed = false;
  };
  int at = corner;
  do {
    add(at);
    at = half_edges.counter_clockwise(at);
  } while (at >= 0 && at != corner);
  if (at >= 0) return result;
  result.is_closed = false;
  for (at = half_edges.clockwise(corner); at >= 0 && at != corner; at = half_edges.clockwise(at)) add(at);
  return result;
}

/// Between the quads of an n-gon's corners.
PointPlaces within_ngon(const Mesh& mesh, const SurfaceParameter& at) {
  const int size = mesh.face_size(at.face);
  if (at.u == 1 && at.v == 1) {
    PointPlaces middle{{}, true};
    for (int k = 0; k < size; ++k) middle.all.push_back({at.face, k, 1, 1});
    return middle;
  }
  if (at.u == 1) return {{at, {at.face, (at.sub + 1) % size, at.v, 1}}, true};
  if (at.v == 1) return {{at, {at.face, (at.sub + size - 1) % size, 1, at.u}}, true};
  return {{at}, true};
}

}  // namespace

PointPlaces places_of(const Mesh& mesh, const SurfaceParameter& at) {
  if (!mesh.has_limit(at.face)) return {{}, false};
  const std::optional<SidePlace> side = side_place(mesh, at);
  if (!side) return is_split_by_corner(mesh, at.face) ? within_ngon(mesh, at) : PointPlaces{{at}, true};
  if (side->along == 0) return around_vertex(mesh, side->side);
  if (side->along == 1) return around_vertex(mesh, mesh.half_edges().next(side->side));
  PointPlaces result{{}, false};
  add_places(mesh, *side, result.all);
  const int twin = mesh.half_edges().twin(side->side);
  result.is_closed = twin != side->side && mesh.has_limit(mesh.half_edges().face(twin));
  if (result.is_closed) add_places(mesh, {twin, 1 - side->along}, result.all);
  return result;
}

}  // namespace shaolin
