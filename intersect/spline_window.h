#pragma once
/// Polynomial patches by rows of control points, which neighbours may share.
#include <array>
#include <cstdint>

#include "../schemes/regular_layout.h"
#include "net.h"

namespace shaolin {

/// Four rows of four places, a coordinate of each.
using Rows = std::array<Four, 4>;

/// How a coordinate of a patch's Bezier points comes from its rows.
template <class Bezier>
class RowMap;

/// By linear maps along u and v, which are kept elsewhere, for as long as this is used.
template <>
class RowMap<BezierQuad> {
  using Maps = BezierQuad::Maps;

 public:
  RowMap(const Maps& maps) : maps_(&maps) {}

  /// The rows are Bezier points.
  static RowMap identity() {
    static const Maps maps{Eigen::Matrix4d::Identity(), Eigen::Matrix4d::Identity()};
    return maps;
  }
  /// The rows are points of the uniform bicubic B-spline.
  static RowMap of_spline() {
    static const Maps maps{BezierQuad::spline_map(), BezierQuad::spline_map()};
    return maps;
  }

  void operator()(const Rows& rows, std::array<double, 16>& bezier) const {
    const double *const u = maps_->u.data(), *const v = maps_->v.data();  // by columns
    for (std::size_t j = 0; j < 4; ++j)
      ((Four(v[j]) * rows[0] + Four(v[j + 4]) * rows[1]) + (Four(v[j + 8]) * rows[2] + Four(v[j + 12]) * rows[3]))
          .store(&bezier[4 * j]);
    const Four u0(u), u1(u + 4), u2(u + 8), u3(u + 12);
    for (std::size_t j = 0; j < 16; j += 4)
      ((u0 * Four(bezier[j]) + u1 * Four(bezier[j + 1])) + (u2 * Four(bezier[j + 2]) + u3 * Four(bezier[j + 3])))
          .store(&bezier[j]);
  }

  /// What the places of a row, or of a column, weigh where Bezier points weigh this much.
  Four u_weights(Four w) const { return transposed(maps_->u.data(), w); }
  Four v_weights(Four w) const { return transposed(maps_->v.data(), w); }

 private:
  static Four transposed(const double* map, Four w) {
    return sums(Four(map) * w, Four(map + 4) * w, Four(map + 8) * w, Four(map + 12) * w);
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
  /// `first`: x of the first place. Rows are `stride` doubles apart, coordinates `plane`.
  SplineWindow(const double* first, std::size_t stride, std::size_t plane, const RowMap<Bezier>& map)
      : map_(map),
        first_(first),
        stride_(static_cast<std::uint8_t>(stride)),
        plane_(static_cast<std::uint8_t>(plane)) {}

  Four row(std::size_t coordinate, std::size_t j) const { return Four(first_ + coordinate * plane_ + j * stride_); }
  const RowMap<Bezier>& to_bezier() const { return map_; }

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
  std::uint8_t stride_, plane_;
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
