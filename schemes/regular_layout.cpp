#include "regular_layout.h"

#include <algorithm>

#include "sharpness.h"

namespace shaolin {

namespace {

SplinePoint point(int index) { return {1, {index}, {1}}; }

/// 2 a - b: the reflection of b in a.
SplinePoint beyond(int a, int b) { return {2, {a, b}, {2, -1}}; }

/// a + b - c: the fourth corner of the parallelogram with the diagonal a-b.
SplinePoint across(int a, int b, int c) { return {3, {a, b, c}, {1, 1, -1}}; }

bool smooth_inside(const Ring& ring) {
  if (ring.cone && ring.closed) return false;
  const auto sharp = [](const Ring::Spoke& spoke) { return is_sharp(spoke.sharpness); };
  if (ring.closed) return std::none_of(ring.spokes.begin(), ring.spokes.end(), sharp);
  return is_infinite(ring.spokes.front().sharpness) && is_infinite(ring.spokes.back().sharpness) &&
         std::none_of(ring.spokes.begin() + 1, ring.spokes.end() - 1, sharp);
}

bool all_faces_have(const Ring& ring, int corners) {
  return std::all_of(ring.faces.begin(), ring.faces.end(),
                     [&](const FaceSides& face) { return face.size() == corners; });
}

/// A corner as its patch sees it: the ring, and the place of the patch's face in it.
struct Corner {
  const Ring& ring;
  std::size_t place;

  int faces() const { return static_cast<int>(ring.faces.size()); }
  /// Spokes counted counter-clockwise from the face's outgoing edge; the ring must have that spoke.
  int spoke(std::size_t i) const { return ring.spokes[(place + i) % ring.spokes.size()].end; }
  /// The vertex diagonally across the i-th quad from the patch's own.
  int diagonal(std::size_t i) const { return ring.faces[(place + i) % ring.faces.size()].vertex(2); }
};

Corner corner_of(const Neighbourhood& n, std::size_t k) {
  return {n.rings[k], static_cast<std::size_t>(place_of_face(n, k))};
}

bool is_regular_quad_corner(const Ring& ring) {
  if (!all_faces_have(ring, 4) || !smooth_inside(ring)) return false;
  if (ring.closed) return ring.faces.size() == 4 && !is_sharp(ring.sharpness);
  if (ring.faces.size() == 2) return !is_sharp(ring.sharpness);
  return ring.faces.size() == 1 && is_infinite(ring.sharpness);
}

bool is_regular_triangle_corner(const Ring& ring) {
  if (!smooth_inside(ring)) return false;
  if (ring.closed) return ring.faces.size() == 6 && !is_sharp(ring.sharpness);
  if (ring.faces.size() == 3) return !is_sharp(ring.sharpness);
  return ring.faces.size() == 1 && is_infinite(ring.sharpness);
}

/// The five points of the 3 x 3 block around a corner that are not the face's, in the corner's own axes (u along the
/// outgoing edge, v along the incoming one): (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1).
std::array<SplinePoint, 5> outer_block(const Corner& corner) {
  const int c = corner.ring.vertex, next = corner.spoke(0), last = corner.spoke(1), opposite = corner.diagonal(0);
  if (corner.ring.closed)
    return {point(corner.diagonal(1)), point(corner.spoke(2)), point(corner.diagonal(2)), point(corner.spoke(3)),
            point(corner.diagonal(3))};
  if (corner.faces() == 1)
    return {beyond(last, opposite),
            beyond(c, next),
            {4, {c, next, last, opposite}, {4, -2, -2, 1}},
            beyond(c, last),
            beyond(next, opposite)};
  if (corner.place == 0) {  // the outgoing edge is sharp: nothing below
    const int left = corner.spoke(2), upper_left = corner.diagonal(1);
    return {point(upper_left), point(left), beyond(left, upper_left), beyond(c, last), beyond(next, opposite)};
  }
  const int below = corner.ring.spokes[0].end, lower_right = corner.ring.faces[0].vertex(2);
  return {beyond(last, opposite), beyond(c, next), beyond(below, lower_right), point(below), point(lower_right)};
}

/// Around a corner of a regular triangle patch, counter-clockwise from the outgoing edge: six neighbours or phantoms.
std::array<SplinePoint, 6> six_neighbours(const Corner& corner) {
  std::array<SplinePoint, 6> around;
  const std::vector<Ring::Spoke>& s = corner.ring.spokes;
  const int c = corner.ring.vertex;
  if (corner.faces() == 1) {
    const int next = s[0].end, last = s[1].end;
    return {point(next), point(last), across(c, last, next), beyond(c, next), beyond(c, last), across(c, next, last)};
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t at = (corner.place + i) % 6;
    if (at < s.size()) {
      around[i] = point(s[at].end);
    } else {
      around[i] = at == 4 ? across(c, s[3].end, s[2].end) : across(c, s[0].end, s[1].end);
    }
  }
  return around;
}

/// The face's own corners, in order.
std::vector<SplinePoint> corners(const Neighbourhood& n) {
  std::vector<SplinePoint> points;
  for (int k = 0; k < n.face.size(); ++k) points.push_back(point(n.face.vertex(k)));
  return points;
}

/// The twelve control points of the box spline's patch.
std::vector<SplinePoint> box_spline_points(const Neighbourhood& n) {
  std::vector<SplinePoint> layout(12);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<SplinePoint, 6> around = six_neighbours(corner_of(n, k));
    layout[k] = point(n.face.vertex(static_cast<int>(k)));
    layout[3 + k] = around[5];
    layout[6 + 2 * k] = around[3];
    layout[7 + 2 * k] = around[4];
  }
  return layout;
}

}  // namespace

std::vector<SplinePoint> bicubic_grid(const Neighbourhood& n) {
  std::vector<SplinePoint> grid(16);
  const auto at = [&](int i, int j) -> SplinePoint& { return grid[static_cast<std::size_t>(4 * j + i)]; };
  constexpr std::array<std::array<int, 2>, 4> places{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}};
  constexpr std::array<std::array<int, 2>, 4> axes{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  constexpr std::array<std::array<int, 2>, 5> block{{{-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto &place = places[k], &u = axes[k], &v = axes[(k + 1) % 4];
    at(place[0], place[1]) = point(n.face.vertex(static_cast<int>(k)));
    const std::array<SplinePoint, 5> outer = outer_block(corner_of(n, k));
    for (std::size_t i = 0; i < 5; ++i) {
      const auto [along_u, along_v] = block[i];
      at(place[0] + along_u * u[0] + along_v * v[0], place[1] + along_u * u[1] + along_v * v[1]) = outer[i];
    }
  }
  return grid;
}

template <>
std::optional<RegularLayout<BezierQuad>> regular_layout(Basis basis, const Neighbourhood& n) {
  if (n.face.size() != 4) return std::nullopt;
  if (basis == Basis::none) return std::nullopt;
  if (basis == Basis::linear) return RegularLayout<BezierQuad>{corners(n), basis};
  if (!std::all_of(n.rings.begin(), n.rings.begin() + 4, is_regular_quad_corner)) return std::nullopt;
  return RegularLayout<BezierQuad>{bicubic_grid(n), basis};
}

template <>
std::optional<RegularLayout<BezierTriangle>> regular_layout(Basis basis, const Neighbourhood& n) {
  if (basis == Basis::none) return std::nullopt;
  if (basis == Basis::linear) return RegularLayout<BezierTriangle>{corners(n), basis};
  if (!std::all_of(n.rings.begin(), n.rings.begin() + 3, is_regular_triangle_corner)) return std::nullopt;
  return RegularLayout<BezierTriangle>{box_spline_points(n), basis};
}

}  // namespace shaolin
