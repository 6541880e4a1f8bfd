#pragma once
/// The pieces of a polynomial patch after a few splits, made from the whole at once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "../schemes/bezier_quad.h"
#include "../schemes/bezier_triangle.h"
#include "net.h"

namespace shaolin {

/// A cut of a piece: the numbers of its parts, and their polynomials.
template <class Bezier, std::size_t size>
struct Cut {
  std::array<int, size> numbers;
  std::array<Bezier, size> parts;
};

/// The pieces of a patch have numbers; 0 is the whole. Those that a cut may lead to are known beforehand, with their
/// maps from the whole's Bezier points: convex combinations, whose weights are multiples of 2^-8 and thus exact.
template <class Bezier>
class Pieces;

/// Rectangles, cut in two along the coordinate in which derivatives vary most; at most twice along each. Along either
/// coordinate they are intervals, numbered as in a heap: 0 is [0, 1], 2 i + 1 and 2 i + 2 are the halves of i.
template <>
class Pieces<BezierQuad> {
 public:
  static constexpr int parts = 2;  ///< of a cut

  Pieces() {
    std::array<BezierQuad, intervals> u, v;  // of a net whose x is the unit to be mapped
    for (std::size_t from = 0; from < 4; ++from) {
      for (std::size_t i = 0; i < 16; ++i) u[0].b[i] = Vec3(i % 4 == from, 0, 0);
      for (std::size_t i = 0; i < intervals; ++i) {
        if (2 * i + 2 < intervals) {
          const auto halves = u[i].halves(0);
          u[2 * i + 1] = halves[0];
          u[2 * i + 2] = halves[1];
        }
        for (std::size_t to = 0; to < 4; ++to) {
          maps_[i].by_from[from][to] = u[i].b[to].x();
          maps_[i].by_to[to][from] = u[i].b[to].x();
        }
      }
    }
  }

  static const SubDomain& domain(int number) {
    static const auto domains = [] {
      std::array<SubDomain, std::size_t{intervals} * intervals> all;
      for (int i = 0; i < intervals * intervals; ++i) {
        const auto u = interval(u_of(i)), v = interval(v_of(i));
        all[static_cast<std::size_t>(i)] = {{u[0], v[0]}, {u[1], v[1]}};
      }
      return all;
    }();
    return domains[static_cast<std::size_t>(number)];
  }

  /// True if a piece may be cut further.
  static bool can_cut(const BezierQuad& piece, int number) {
    const int axis = bent_axis(piece);
    return 2 * (axis == 0 ? u_of(number) : v_of(number)) + 2 < intervals;
  }
  static Cut<BezierQuad, 2> cut(const BezierQuad& piece, int number) {
    const int u = u_of(number), v = v_of(number);
    if (bent_axis(piece) == 0) return {{of(2 * u + 1, v), of(2 * u + 2, v)}, piece.halves(0)};
    return {{of(u, 2 * v + 1), of(u, 2 * v + 2)}, piece.halves(1)};
  }

  /// A coordinate of a piece from that of the whole.
  const std::array<double, 16>& restrict_to(int number, const std::array<double, 16>& from,
                                            std::array<double, 16>& to) const {
    const int u_number = u_of(number), v_number = v_of(number);
    if (v_number == 0) {
      to = from;
    } else {
      const Map& v = maps_[static_cast<std::size_t>(v_number)];
      const Four row0(&from[0]), row1(&from[4]), row2(&from[8]), row3(&from[12]);
      for (std::size_t j = 0; j < 4; ++j) {
        const std::array<double, 4>& w = v.by_to[j];
        ((Four(w[0]) * row0 + Four(w[1]) * row1) + (Four(w[2]) * row2 + Four(w[3]) * row3)).store(&to[4 * j]);
      }
    }
    if (u_number == 0) return to;
    const Map& u = maps_[static_cast<std::size_t>(u_number)];
    const Four u0(u.by_from[0].data()), u1(u.by_from[1].data()), u2(u.by_from[2].data()), u3(u.by_from[3].data());
    for (std::size_t j = 0; j < 16; j += 4)
      ((u0 * Four(to[j]) + u1 * Four(to[j + 1])) + (u2 * Four(to[j + 2]) + u3 * Four(to[j + 3]))).store(&to[j]);
    return to;
  }

 private:
  static constexpr int intervals = 7;
  static constexpr int of(int u, int v) { return intervals * v + u; }
  static constexpr int u_of(int number) { return number % intervals; }
  static constexpr int v_of(int number) { return number / intervals; }
  /// Where one begins, and how long it is.
  static constexpr std::array<double, 2> interval(int i) {
    if (i == 0) return {0, 1};
    return i < 3 ? std::array{(i - 1) * 0.5, 0.5} : std::array{(i - 3) * 0.25, 0.25};
  }

  /// Four points of a cubic to those of an interval.
  struct Map {
    std::array<std::array<double, 4>, 4> by_from, by_to;  ///< [from][to], [to][from]
  };

  /// The coordinate along which halving takes more from the variation of the derivatives against their own size:
  /// second differences along u are du's along u and dv's along u.
  static int bent_axis(const BezierQuad& piece) {
    double uu = 0, uv = 0, vv = 0;
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 *const row = &piece.b[4 * j + i], *const column = &piece.b[4 * i + j];
        uu = std::max(uu, (row[2] - 2 * row[1] + row[0]).squaredNorm());
        vv = std::max(vv, (column[8] - 2 * column[4] + column[0]).squaredNorm());
      }
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3* const p = &piece.b[4 * j + i];
        uv = std::max(uv, ((p[5] - p[4]) - (p[1] - p[0])).squaredNorm());
      }
    const double du = BezierQuad::mean_du(piece.b).squaredNorm(), dv = BezierQuad::mean_dv(piece.b).squaredNorm();
    return std::max(uu * dv, uv * du) >= std::max(uv * dv, vv * du) ? 0 : 1;
  }

  std::array<Map, intervals> maps_;
};

/// Triangles, quartered at most twice, numbered as in a heap: 4 p + 1 + k is the quarter k of piece p, in the order of
/// Domain.
template <>
class Pieces<BezierTriangle> {
 public:
  static constexpr int parts = 4;

  Pieces() {
    for (std::size_t from = 0; from < BezierTriangle::size; ++from) {
      std::array<BezierTriangle, count> pieces;
      pieces[0].b.fill(Vec3::Zero());
      pieces[0].b[from].setOnes();
      for (std::size_t p = 0; p < count; ++p) {
        if (4 * p + 4 < count) {
          const auto quarters = pieces[p].split();
          std::copy(quarters.begin(), quarters.end(), pieces.begin() + static_cast<std::ptrdiff_t>(4 * p + 1));
        }
        weights_[p][from] = Net(pieces[p]).x;
      }
    }
  }

  static SubDomain domain(int number) {
    return number == 0 ? SubDomain() : domain((number - 1) / 4)(child_domain<FaceKind::triangle>((number - 1) % 4));
  }

  static bool can_cut(const BezierTriangle&, int number) { return 4 * number + 4 < count; }
  static Cut<BezierTriangle, 4> cut(const BezierTriangle& piece, int number) {
    const int first = 4 * number + 1;
    return {{first, first + 1, first + 2, first + 3}, piece.split()};
  }

  const std::array<double, 16>& restrict_to(int number, const std::array<double, 16>& from,
                                            std::array<double, 16>& to) const {
    if (number == 0) return to = from;
    const auto& weights = weights_[static_cast<std::size_t>(number)];
    std::array<Four, 4> sum{Four(0.0), Four(0.0), Four(0.0), Four(0.0)};
    for (std::size_t k = 0; k < BezierTriangle::size; ++k)
      for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] + Four(&weights[k][4 * i]) * Four(from[k]);
    for (std::size_t i = 0; i < 4; ++i) sum[i].store(&to[4 * i]);
    return to;
  }

 private:
  static constexpr int count = 21;

  std::array<std::array<std::array<double, 16>, BezierTriangle::size>, count> weights_;  ///< [piece][from][to]
};

/// The one table of each kind.
template <class Bezier>
inline const Pieces<Bezier> pieces_of;

}  // namespace shaolin
