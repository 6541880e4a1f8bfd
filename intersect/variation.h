#pragma once
/// How much the derivatives of a flat piece vary, in few bytes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "contraction.h"
#include "net.h"

namespace shaolin {

/// Of a piece S of a polynomial, in the coordinates of Su, Sv and N, where Su and Sv are its derivatives at the
/// domain's centre and N = 2^-k Su x Sv, about sqrt(|Su x Sv|) long: how far it leaves its tangent plane's map there,
/// and how far its derivatives are from Su and Sv, all over the domain. It does not depend on what a ray sees of the
/// piece.
///
/// Bounds are rounded up to eight bits, four of them the exponent; with k 14 bytes in all.
class Variation {
 public:
  /// Nothing is known: all are infinite.
  Variation() { bits_.fill(infinite); }

  /// Of a piece given by its Bezier points.
  template <class Bezier>
  static Variation of(const Net& piece);

  /// N over Su x Sv.
  double n_scale() const { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent_) << 52); }

  enum Axis : std::uint8_t { along_su, along_sv, along_n };
  /// S(p) - S(c) - (p - c).(Su, Sv) is at most this, and at least -below.
  double above(Axis axis) const { return value(bits_[axis]); }
  double below(Axis axis) const { return value(bits_[3 + axis]); }
  /// How far derivatives differ from Su, and from Sv.
  double of_du(Axis axis) const { return value(bits_[6 + axis]); }
  double of_dv(Axis axis) const { return value(bits_[9 + axis]); }

 private:
  /// A double between 2^-9 and 2^7 without its sign and the upper bits of its exponent, which are the same for all, and
  /// without the lower bits of its fraction.
  static constexpr std::uint64_t least = std::uint64_t{1023 - 9} << 52;
  static constexpr std::uint8_t infinite = 0xff;
  static std::uint8_t rounded_up(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    if (value <= 0x1p-9) return 0;
    if (!(value < 0x1p7)) return infinite;
    const std::uint64_t code = (bits - least + 0xffffffffffff) >> 48;
    return static_cast<std::uint8_t>(std::min<std::uint64_t>(code, infinite));
  }
  static double value(std::uint8_t code) {
    const auto finite = std::bit_cast<double>((std::uint64_t{code} << 48) + least);
    return code == infinite ? std::numeric_limits<double>::infinity() : finite;
  }

  std::array<std::uint8_t, 12> bits_;
  std::int16_t exponent_ = 0;  ///< k
};

/// Differences from a linear map and derivatives are combinations of control values, so that the largest of those will
/// do. What is rounded here is less than the error of coordinates moves them by (see FlatFinish), but for the
/// directions of the basis: they are good to 1e-9 unless the piece is a needle by 1e6 or more, of which nothing is
/// said.
template <class Bezier>
Variation Variation::of(const Net& piece) {
  using D = typename Bezier::DomainType;
  static const auto weights = Bezier::weights(D::centre());
  static const Net places = Net(Bezier::from_corners([] {
    std::array<Vec3, Bezier::spline_size> corners{};
    for (std::size_t k = 0; k < D::corners.size(); ++k)
      corners[k] = Vec3(D::corners[k][0] - D::centre().x(), D::corners[k][1] - D::centre().y(), 0);
    return corners;
  }()));
  const auto at_centre = [&](const std::array<double, 16>& of) {
    return Vec3(dot(piece.x, of), dot(piece.y, of), dot(piece.z, of));
  };
  const Vec3 su = at_centre(weights.du), sv = at_centre(weights.dv), product = su.cross(sv);
  Variation variation;
  constexpr double least_area = 0x1p-500;  // so that no product of four lengths is lost
  const double area = product.norm();
  if (!(area > 1e-6 * su.norm() * sv.norm() && area > least_area && area < 1 / least_area)) return variation;
  variation.exponent_ = static_cast<std::int16_t>(std::ilogb(area) >> 1);
  const Vec3 n = variation.n_scale() * product;
  const std::array<Vec3, 3> dual{sv.cross(n) / su.dot(sv.cross(n)), n.cross(su) / su.dot(sv.cross(n)),
                                 n / n.squaredNorm()};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& way = dual[axis];
    std::array<double, 16> along, plane;
    combine(way.x(), piece.x, way.y(), piece.y, along);
    combine(1, along, way.z(), piece.z, along);
    const Deviation most = deviation<Bezier>(along, axis == along_su, axis == along_sv);
    constexpr double slack = 1e-8;
    variation.bits_[6 + axis] = rounded_up(most.along_u + slack);
    variation.bits_[9 + axis] = rounded_up(most.along_v + slack);
    combine(axis == along_su, places.x, axis == along_sv, places.y, plane);
    combine(1, along, -1, plane, along);
    const double centre = dot(along, weights.value);
    const Range range(along);
    variation.bits_[axis] = rounded_up(std::max(range.high - centre, 0.0) + slack);
    variation.bits_[3 + axis] = rounded_up(std::max(centre - range.low, 0.0) + slack);
  }
  return variation;
}

}  // namespace shaolin
