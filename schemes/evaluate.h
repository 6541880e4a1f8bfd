#pragma once
/// Evaluation of a patch anywhere: split until the parameter lies in a regular piece.
#include <cmath>

#include "corner_limit.h"
#include "whitening.h"

namespace shaolin {

namespace detail {

/// A parameter that is no corner has a bit set above 2^-1074, so fewer splits bring it to a corner or past one, and ten
/// more wear semi-sharp values down.
constexpr int most_levels = 1100;

/// The corner of the domain that a parameter is nearest to.
template <Scheme S>
int nearest_corner(const Parameter& p) {
  const bool right = p.x() > 0.5, above = p.y() > 0.5;
  if (S::face_kind == FaceKind::quad) return above ? (right ? 2 : 3) : right;
  return above ? 2 : right;
}

template <Scheme S>
Parameter corner_parameter(int k) {
  const auto& corner = Domain<S::face_kind>::corners[static_cast<std::size_t>(k)];
  return {corner[0], corner[1]};
}

/// The vector times 2^exponent, which itself may be no double.
inline Vec3 times_power(const Vec3& vector, int exponent) {
  return vector.unaryExpr([=](double x) { return std::ldexp(x, exponent); });
}

/// A piece under the magnifying glass: its points are the surface's less an anchor, times 2^points; its parameters are
/// the root's times sign 2^parameters. (In exponents: 1100 levels deep their powers are no doubles.)
struct Zoom {
  double sign = 1;
  int parameters = 0, points = 0;
};

/// The unit normal of two derivatives; zero if they are parallel.
inline Vec3 unit_normal(const Vec3& du, const Vec3& dv) {
  const Vec3 normal = du.cross(dv);
  const double square = normal.squaredNorm();
  if (square > 0x1p-900 && square < 0x1p900) return normal / std::sqrt(square);
  // The product of tiny vectors underflows, that of huge ones overflows.
  return du.stableNormalized().cross(dv.stableNormalized()).stableNormalized();
}

/// The polynomial's sample.
template <class Regular>
LimitSample sample(const Regular& piece, const Parameter& at, const Vec3& anchor, const Zoom& zoom) {
  Derivatives d = piece.derivatives(at);
  const Vec3 normal = unit_normal(d.du, d.dv);
  const int first = zoom.parameters - zoom.points, second = first + zoom.parameters;
  for (Vec3* derivative : {&d.du, &d.dv}) *derivative = zoom.sign * times_power(*derivative, first);
  for (Vec3* derivative : {&d.duu, &d.duv, &d.dvv}) *derivative = times_power(*derivative, second);
  return {anchor + times_power(piece.position(at), -zoom.points), normal, d};
}

}  // namespace detail

/// See below. `one_sided`: where masks give no normal, look for the one that the patch's own side approaches.
template <Scheme S>
LimitSample evaluate(Patch<S> patch, Parameter at, bool one_sided = true);

/// The normal that a patch's own side approaches at its corner k. 100 splits towards the corner leave 0.66^100 of any
/// mode that lags behind by the slowest eigenvalue. Modes shrink at different rates (around an infinitely sharp vertex
/// between smooth edges the surface is a spike), and their differences would lose all digits; so a linear map gives the
/// net equal extent along its principal axes after each split. Normals go back by the map's transpose.
template <Scheme S>
Vec3 one_sided_normal(Patch<S> patch, int k) {
  constexpr int levels = 100;
  Eigen::Matrix3d to_whitened = Eigen::Matrix3d::Identity();
  for (int level = 0; level < levels; ++level) {
    patch = patch.child(k);
    const Vec3 corner = patch.points[static_cast<std::size_t>(k)];
    for (Vec3& point : patch.points) point -= corner;
    const std::optional<Eigen::Matrix3d> whiten = whitening(patch.points);
    if (!whiten) break;
    for (Vec3& point : patch.points) point = *whiten * point;
    to_whitened = *whiten * to_whitened;
    to_whitened /= to_whitened.cwiseAbs().maxCoeff();
  }
  const Vec3 normal = evaluate(std::move(patch), Domain<S::face_kind>::centre(), false).normal;
  return (to_whitened.transpose() * normal).normalized();
}

/// The limit at a corner of a patch: no derivatives. Where masks give no normal, the one that its own face approaches
/// stands in, or zero if that is not asked for.
template <Scheme S>
std::optional<LimitSample> evaluate_corner(const Patch<S>& patch, int k, bool one_sided = true) {
  const std::optional<LimitAtCorner> limit = corner_limit(patch, k);
  if (!limit) return {};
  const bool has_normal = limit->normal && limit->normal->allFinite() && !limit->normal->isZero(0);
  if (has_normal) return LimitSample{limit->position, *limit->normal, {}};
  return LimitSample{limit->position, one_sided ? one_sided_normal(patch, k) : Vec3(Vec3::Zero()), {}};
}

/// Position, normal and derivatives of the limit at a parameter of a patch whose face is of the scheme's own kind.
///
/// Near an irregular corner the patch shrinks by about half a level, so differences of control points would lose all
/// their digits. Every few levels the corner's limit point is therefore subtracted from the control points (masks are
/// affine) and kept in `anchor`, and the points are magnified by powers of two. Then positions are exact to an ulp, and
/// first derivatives keep their precision however deep the descent; second ones carry some 50 u (size of the patch) /
/// (distance from the corner). So do normals, unless the surface flattens to a line there (around a rounded corner of
/// one face, or a spike): at a distance d in parameters such a normal is good to u / d. It ends: a parameter other than
/// a corner lies 2^-1074 from it at least. Without polynomials a parameter is found as a corner: each split takes a bit
/// off it, so most end after 53; there are no derivatives then.
template <Scheme S>
LimitSample evaluate(Patch<S> patch, Parameter at, bool one_sided) {
  using D = Domain<S::face_kind>;
  constexpr int levels_between_anchors = 8;
  Vec3 anchor = Vec3::Zero();
  detail::Zoom zoom;
  at = D::nearest(at);
  for (int level = 0, anchored = -levels_between_anchors; !patch.is_regular(); ++level) {
    const int corner = detail::nearest_corner<S>(at);
    // Only a scheme that does not converge comes here.
    if (level > detail::most_levels)
      return {
          anchor + detail::times_power(patch.points[static_cast<std::size_t>(corner)], -zoom.points), Vec3::Zero(), {}};
    if (at == detail::corner_parameter<S>(corner) && !patch.child(corner).is_regular()) {
      if (std::optional<LimitSample> limit = evaluate_corner(patch, corner, one_sided)) {
        limit->position = anchor + detail::times_power(limit->position, -zoom.points);
        return *limit;
      }
    }
    if (level >= anchored + levels_between_anchors) {
      if (const std::optional<LimitAtCorner> limit = corner_limit(patch, corner)) {
        const int more = level - std::max(anchored, 0);
        for (Vec3& point : patch.points) point = detail::times_power(point - limit->position, more);
        anchor += detail::times_power(limit->position, -zoom.points);
        zoom.points += more;
        anchored = level;
      }
    }
    const ChildParameter inside = D::to_child(at);
    patch = patch.child(inside.child);
    at = D::nearest(inside.at);  // a rounding may leave the middle child of a triangle
    zoom.sign *= std::copysign(1.0, D::scale(inside.child));
    zoom.parameters -= std::ilogb(D::scale(inside.child));
  }
  return detail::sample(patch.regular(), at, anchor, zoom);
}

}  // namespace shaolin
