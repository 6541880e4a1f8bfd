#pragma once
/// Polynomial patches by rows of control points, which neighbours may share.
#include <array>
#include <cstddef>

#include "../schemes/regular_layout.h"
#include "net.h"

namespace shaolin {

/// Four rows of four places, a coordinate of each.
using Rows = std::array<Four, 4>;

/// What four places of a line weigh in a cubic and in its derivatives, made in registers: what is stored a number at a
/// time and loaded four at a time waits for the stores.
struct CubicWeights {
  Four value, first, second;

  /// Bernstein polynomials: with s = 1 - t, (s^3, 3 s^2 t, 3 s t^2, t^3).
  static CubicWeights of_bezier(double t) {
    const double s = 1 - t;
    const Four near(s, s, t, t), either(s, t, s, t), of_s(s), of_t(t);
    return {near * near * (Four(1, 3, 3, 1) * either), near * (Four(-3, 3, 6, 0) * of_s + Four(0, -6, -3, 3) * of_t),
            Four(6, -12, 6, 0) * of_s + Four(0, 6, -12, 6) * of_t};
  }
  /// The uniform B-spline's: with s = 1 - t, (s^3, 4 - 6 t^2 + 3 t^3, 4 - 6 s^2 + 3 s^3, t^3) / 6.
  static CubicWeights of_spline(double t) {
    const double s = 1 - t;
    const Four x(s, t, s, t), flat(0, -1, -1, 0), cubic(1.0 / 6, 0.5, 0.5, 1.0 / 6);
    const Four way(-1, 1, -1, 1);  // dx / dt
    return {Four(0, 2.0 / 3, 2.0 / 3, 0) + x * x * (flat + cubic * x), way * x * (Four(2) * flat + Four(3) * cubic * x),
            Four(2) * flat + Four(6) * cubic * x};
  }
};

/// How a coordinate of a patch's Bezier points comes from its rows.
template <class Bezier>
class RowMap;

/// By linear maps along u and v, which are kept elsewhere, for as long as this is used.
template <>
class RowMap<BezierQuad> {
  using LineMap = BezierQuad::LineMap;
  using Maps = BezierQuad::Maps;

 public:
  RowMap(const Maps& maps) : maps_(&maps) {}

  /// The rows are Bezier points.
  static RowMap identity() {
    static const Maps maps{BezierQuad::identity_map(), BezierQuad::identity_map()};
    return maps;
  }
  /// The rows are points of the uniform bicubic B-spline.
  static RowMap of_spline() {
    static const Maps maps{BezierQuad::spline_map(), BezierQuad::spline_map()};
    return maps;
  }

  void operator()(Rows rows, std::array<double, 16>& bezier) const {
    across(maps_->v, rows);
    if (maps_->u.kind != LineMap::Kind::identity) {
      transpose(rows[0], rows[1], rows[2], rows[3]);
      across(maps_->u, rows);
      transpose(rows[0], rows[1], rows[2], rows[3]);
    }
    for (std::size_t j = 0; j < 4; ++j) rows[j].store(&bezier[4 * j]);
  }

  /// What the places of a row, or of a column, weigh in the polynomial and its derivatives.
  CubicWeights u_weights(double u) const { return weights(maps_->u, u); }
  CubicWeights v_weights(double v) const { return weights(maps_->v, v); }

 private:
  /// Maps four lines, place by place. The spline's, by thirds: its Bezier points are a third of the way from point to
  /// point, and the middles of those.
  static void across(const LineMap& map, Rows& lines) {
    const Four p0 = lines[0], p1 = lines[1], p2 = lines[2], p3 = lines[3];
    if (map.kind == LineMap::Kind::spline) {
      const Four third(1.0 / 3), half(0.5), step = third * (p2 - p1);
      lines[1] = p1 + step;
      lines[2] = p2 - step;
      lines[0] = half * ((p1 - third * (p1 - p0)) + lines[1]);
      lines[3] = half * (lines[2] + (p2 + third * (p3 - p2)));
    } else if (map.kind == LineMap::Kind::other) {
      const double* const w = map.matrix.data();  // by columns
      for (std::size_t j = 0; j < 4; ++j)
        lines[j] = (Four(w[j]) * p0 + Four(w[j + 4]) * p1) + (Four(w[j + 8]) * p2 + Four(w[j + 12]) * p3);
    }
  }

  /// What Bezier points weigh is put back to the places.
  static CubicWeights weights(const LineMap& map, double t) {
    if (map.kind == LineMap::Kind::spline) return CubicWeights::of_spline(t);
    const CubicWeights bezier = CubicWeights::of_bezier(t);
    if (map.kind == LineMap::Kind::identity) return bezier;
    const double* const m = map.matrix.data();
    const Four place0(m), place1(m + 4), place2(m + 8), place3(m + 12);
    const auto back = [&](Four w) { return sums(place0 * w, place1 * w, place2 * w, place3 * w); };
    return {back(bezier.value), back(bezier.first), back(bezier.second)};
  }

  const Maps* maps_;
};

/// They are the rows, as Net has them. (From points of the box spline, 12 to 15 by a matrix, rays took 13 % longer at
/// `spot_loop`, for 27 % less memory, of which tessellations take 30 times as much.)
template <>
class RowMap<BezierTriangle> {
 public:
  static RowMap identity() { return {}; }
  void operator()(const Rows& rows, std::array<double, 16>& bezier) const {
    for (std::size_t j = 0; j < 4; ++j) rows[j].store(&bezier[4 * j]);
  }
};

/// A polynomial patch by rows of points that others keep, and what makes Bezier points of them.
template <class Bezier>
class SplineWindow {
 public:
  /// `first`: x of the first place of a square grid with so many places a side, whose coordinates follow each other.
  SplineWindow(const double* first, std::size_t side, const RowMap<Bezier>& map)
      : map_(map), first_(first), side_(side) {}

  Four row(std::size_t coordinate, std::size_t j) const { return Four(first_ + (coordinate * side_ + j) * side_); }
  const RowMap<Bezier>& to_bezier() const { return map_; }
  const double* first() const { return first_; }
  std::size_t side() const { return side_; }

  /// The Bezier points.
  Net net() const {
    Net net;
    std::size_t coordinate = 0;
    for (auto* const points : {&net.x, &net.y, &net.z}) {
      map_({row(coordinate, 0), row(coordinate, 1), row(coordinate, 2), row(coordinate, 3)}, *points);
      ++coordinate;
    }
    return net;
  }

 private:
  [[no_unique_address]] RowMap<Bezier> map_;
  const double* first_;
  std::size_t side_;
};

/// The spline points of the bicubics that a quad splits into: five rows of five places, of which each child's window is
/// four by four.
class SplineGrid {
 public:
  static constexpr std::size_t side = 5, plane = side * side;
  using Spline = std::array<Vec3, BezierQuad::spline_size>;

  SplineGrid() { coordinates_.fill(0); }

  /// Puts points into the window that begins at a place. Returns false, and changes nothing, if others stand there
  /// already, as beyond the end of a crease.
  bool add(const Spline& spline, std::size_t first) {
    for (std::size_t i = 0; i < spline.size(); ++i)
      if (const std::size_t at = place(first, i); is_set_[at] && point(at) != spline[i]) return false;
    for (std::size_t i = 0; i < spline.size(); ++i) {
      const std::size_t at = place(first, i);
      is_set_[at] = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
        coordinates_[axis * plane + at] = spline[i][static_cast<Eigen::Index>(axis)];
    }
    return true;
  }

  const std::array<double, 3 * plane>& coordinates() const { return coordinates_; }

 private:
  static std::size_t place(std::size_t first, std::size_t i) { return first + side * (i / 4) + i % 4; }
  Vec3 point(std::size_t at) const {
    return {coordinates_[at], coordinates_[plane + at], coordinates_[2 * plane + at]};
  }

  std::array<double, 3 * plane> coordinates_;
  std::array<bool, plane> is_set_{};
};

}  // namespace shaolin
