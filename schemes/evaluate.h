#pragma once
/// Evaluation of a patch anywhere: split until the parameter lies in a regular piece.
#include <cmath>
#include <limits>

#include "corner_limit.h"

namespace shaolin {

namespace detail {

/// The corner of the domain that a parameter is nearest to.
template <Scheme S>
int nearest_corner(const Parameter& p) {
  using D = Domain<S::face_kind>;
  int best = 0;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < D::corners.size(); ++k) {
    const double distance = std::hypot(p.x() - D::corners[k][0], p.y() - D::corners[k][1]);
    if (distance < best_distance) {
      best_distance = distance;
      best = static_cast<int>(k);
    }
  }
  return best;
}

template <Scheme S>
Parameter corner_parameter(int k) {
  const auto& corner = Domain<S::face_kind>::corners[static_cast<std::size_t>(k)];
  return {corner[0], corner[1]};
}

/// The polynomial's sample. Its points are the surface's less `anchor`, times `magnification`; its parameters are the
/// root's times `scale`.
template <class Regular>
LimitSample sample(const Regular& piece, const Parameter& at, const Vec3& anchor, double scale, double magnification) {
  Derivatives d = piece.derivatives(at);
  // Normalised first: the product of tiny vectors would underflow.
  const Vec3 normal = d.du.stableNormalized().cross(d.dv.stableNormalized()).stableNormalized();
  const double first = scale / magnification;
  d.du *= first;
  d.dv *= first;
  d.duu *= first * scale;
  d.duv *= first * scale;
  d.dvv *= first * scale;
  return {anchor + piece.position(at) / magnification, normal, d};
}

}  // namespace detail

template <Scheme S>
LimitSample evaluate(Patch<S> patch, Parameter at);

/// The limit at a corner of a patch, by masks: no derivatives. Where the surface has no normal there, the one that its
/// own face approaches along the diagonal stands in.
template <Scheme S>
std::optional<LimitSample> evaluate_corner(const Patch<S>& patch, int k) {
  const std::optional<LimitAtCorner> limit = corner_limit(patch, k);
  if (!limit) return {};
  if (limit->normal && limit->normal->allFinite()) return LimitSample{limit->position, *limit->normal, {}};
  const Parameter corner = detail::corner_parameter<S>(k);
  constexpr double close = 0x1p-30;
  const Parameter beside = corner + close * (Domain<S::face_kind>::centre() - corner);
  return LimitSample{limit->position, evaluate(patch, beside).normal, {}};
}

/// Position, normal and derivatives of the limit at a parameter of a patch whose face is of the scheme's own kind.
///
/// Near an irregular corner the patch shrinks by about half a level, so differences of control points would lose all
/// their digits. Every few levels the corner's limit point is therefore subtracted from the control points (masks are
/// affine) and kept in `anchor`, and the points are magnified by powers of two. Then positions are exact to an ulp, and
/// normals and derivatives keep their precision however deep the descent. It ends: a parameter other than a corner lies
/// 2^-1074 from it at least.
template <Scheme S>
LimitSample evaluate(Patch<S> patch, Parameter at) {
  using D = Domain<S::face_kind>;
  constexpr int levels_between_anchors = 8;
  Vec3 anchor = Vec3::Zero();
  double scale = 1, magnification = 1;
  at = D::nearest(at);
  for (int level = 0, anchored = -levels_between_anchors; !patch.is_regular(); ++level) {
    const int corner = detail::nearest_corner<S>(at);
    if (at == detail::corner_parameter<S>(corner) && !patch.child(corner).is_regular()) {
      if (std::optional<LimitSample> limit = evaluate_corner(patch, corner)) {
        limit->position = anchor + limit->position / magnification;
        return *limit;
      }
    }
    if (level >= anchored + levels_between_anchors) {
      if (const std::optional<LimitAtCorner> limit = corner_limit(patch, corner)) {
        const double more = std::ldexp(1.0, level - std::max(anchored, 0));
        for (Vec3& point : patch.points) point = (point - limit->position) * more;
        anchor += limit->position / magnification;
        magnification *= more;
        anchored = level;
      }
    }
    const ChildParameter inside = D::to_child(at);
    patch = patch.child(inside.child);
    at = inside.at;
    scale /= D::scale(inside.child);
  }
  return detail::sample(patch.regular(), at, anchor, scale, magnification);
}

}  // namespace shaolin
