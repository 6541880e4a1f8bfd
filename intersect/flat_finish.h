#pragma once
/// The zero of a flat piece of a polynomial, or the proof that there is none, where either is clear.
#include <array>
#include <cmath>

#include "contraction.h"
#include "counters.h"
#include "net_evaluation.h"
#include "newton_finish.h"
#include "ray.h"
#include "variation.h"

namespace shaolin {

/// What NewtonFinish does for a ray and any cell, without the cell's control points in the ray's coordinates: from the
/// surface's own derivatives, and how much they vary. It decides what is clear: that a piece has no point on the ray,
/// or one alone, well within its sides. The rest is NewtonFinish's: grazing rays, rays along edges, pieces near
/// rounding.
///
/// With S the piece's polynomial, o and d the ray's origin and unit direction, S(p) = o + t d is three equations. Their
/// Jacobian at the domain's centre c is (Su, Sv, -d); two rows of its inverse, r_1 = (d x Sv) / D and
/// r_2 = -(d x Su) / D with D = Su . (d x Sv), leave t out: the map g(p) = (r_1 . (S(p) - o), r_2 . (S(p) - o))
/// vanishes where the ray is met. A vector a Su + b Sv + c N becomes (a + c r_1.N, b + c r_2.N): so Variation's bounds
/// are those of g's derivatives against the identity, a_ij, and of g against its linear part. r_i.N is what grazing
/// rays make large.
///
/// T(p) = p - g(p) moves less than p: from T(c) by no more than g leaves its linear part, and from another T(q) by
/// a |p - q| at most, coordinate by coordinate. A zero is a place with T(p) = p, so that zeros are in the rectangle
/// around T(c), and around every T(q), where all places lie that T takes known enclosures of them to (Enclosure). If it
/// leaves nothing of the domain there is none. If the rectangle is all within the domain, T takes the enclosure into
/// itself: there is one. There are never two if a is below 1 in some norm (Contraction).
///
/// `error` is that of coordinates across the ray (RayFrame::error). A point within it of the ray, in both, moves g_i by
/// s_i = |r_i| sqrt(2) error at most, and derivatives, in g, by 8 s_i; here and where the variation was found, 16. That
/// r_i . d is not quite zero costs 4 u |r_i| times the distance, which the error's last term covers; r_i is bounded by
/// |Sv| / |D| and |Su| / |D| in place of its own length, for of a ray nearly along Su or Sv products round so much.
template <class Bezier>
class FlatFinish {
  using D = typename Bezier::DomainType;

 public:
  enum class Verdict { none, found, unknown };

  /// A piece of a patch. All three must outlive this.
  FlatFinish(const SplineWindow<Bezier>& patch, const SubDomain& piece, const Variation& variation)
      : patch_(patch), piece_(piece), variation_(variation) {}

  /// Between ray.near and `far`, as NewtonFinish has them. `any`: that there is a zero is enough, the hit's place is
  /// known to its radius only.
  Verdict solve(const TraversalRay& ray, double far, bool far_is_hit, double error, bool any, RayCounters& counters,
                PatchHit& hit) const;

 private:
  /// How near the piece's sides, in its parameters, a zero may be that is clearly inside.
  static constexpr double margin = 0x1p-20;
  /// What rounding may move g by, for a piece to be asked here.
  static constexpr double most_moved = 0x1p-24;
  static constexpr int most_steps = 8;

  /// Where in the domain zeros may be.
  class Enclosure {
   public:
    /// Not outside of a rectangle. Returns false if that leaves nothing.
    bool narrow(const Parameter& centre, const Parameter& half) {
      low_ = low_.cwiseMax(centre - half);
      high_ = high_.cwiseMin(centre + half);
      return !((low_.array() > high_.array()).any() || (D::corner_count == 3 && low_.sum() > 1));
    }
    /// The distance, coordinate by coordinate, that no place of it exceeds.
    Parameter farthest(const Parameter& from) const { return (from - low_).cwiseMax(high_ - from); }

   private:
    Parameter low_ = Parameter::Zero(), high_ = Parameter::Ones();
  };

  static Four four(const Vec3& v) { return {v.x(), v.y(), v.z(), 0}; }
  static std::array<double, 4> values(Four four) {
    std::array<double, 4> v;
    four.store(v.data());
    return v;
  }

  const SplineWindow<Bezier>& patch_;
  const SubDomain& piece_;
  const Variation& variation_;
};

template <class Bezier>
SHAOLIN_FLATTEN auto FlatFinish<Bezier>::solve(const TraversalRay& ray, double far, bool far_is_hit, double error,
                                               bool any, RayCounters& counters, PatchHit& hit) const -> Verdict {
  using V = Variation;
  ++counters.cells;
  const Four direction = four(ray.direction), origin = four(ray.origin), none(0.0);
  const Four scale_u(piece_.scale.x()), scale_v(piece_.scale.y());
  Parameter at = D::centre();
  PatchEvaluation<Bezier> surface(patch_, piece_(at));
  Four from = surface.position() - origin, du = scale_u * surface.du(), dv = scale_v * surface.dv();
  const Four across_u = cross(direction, du), across_v = cross(direction, dv), normal = cross(du, dv);
  const auto products = values(sums(du * across_v, from * across_v, from * across_u, direction * from));
  const auto sizes = values(sums(normal * across_v, normal * across_u, abs(du), abs(dv)));
  const double determinant = products[0], distance = products[3], length_u = sizes[2], length_v = sizes[3];
  // Where a needle or a grazing ray makes it smaller, products round to fewer digits than the bounds make up for.
  constexpr double least_share = 1e-6;
  if (!(std::abs(determinant) > least_share * length_u * length_v)) return Verdict::unknown;
  const double inverse = 1 / determinant;
  const Parameter moved = 1.5 * error * std::abs(inverse) * Parameter(length_v, length_u);
  if (!(moved.maxCoeff() <= most_moved)) return Verdict::unknown;

  Parameter g = inverse * Parameter(products[1], -products[2]);
  const Parameter n = inverse * variation_.n_scale() * Parameter(sizes[0], -sizes[1]);
  const Parameter n_above = n.cwiseMax(0.0), n_below = n_above - n;
  const double bend_above = variation_.above(V::along_n), bend_below = variation_.below(V::along_n);
  const Parameter above = Parameter(variation_.above(V::along_su), variation_.above(V::along_sv)) +
                          n_above * bend_above + n_below * bend_below;
  const Parameter below = Parameter(variation_.below(V::along_su), variation_.below(V::along_sv)) +
                          n_above * bend_below + n_below * bend_above;
  constexpr double rounding = 1 + 1e-9;
  Parameter image = at - g + 0.5 * (below - above), room = rounding * (0.5 * (below + above) + 4 * moved);
  Enclosure zeros;
  if (!zeros.narrow(image, room)) return Verdict::none;

  const Parameter size_n = n_above + n_below, slack = 16 * moved + Parameter::Constant(1e-9);
  Eigen::Matrix2d most;
  most.col(0) = Parameter(variation_.of_du(V::along_su), variation_.of_du(V::along_sv)) +
                variation_.of_du(V::along_n) * size_n + slack;
  most.col(1) = Parameter(variation_.of_dv(V::along_su), variation_.of_dv(V::along_sv)) +
                variation_.of_dv(V::along_n) * size_n + slack;
  const Contraction contracts = contraction(most);
  if (!(contracts.share < 0.95)) return Verdict::unknown;

  const auto is_proven = [&] {
    if (!D::contains(image, room)) return false;
    // From the centre to anywhere in the piece it is no farther than derivatives are long: the sides are 1.
    const double length_n = variation_.n_scale() * length_u * length_v;
    const double longest_u = (1 + variation_.of_du(V::along_su)) * length_u + variation_.of_du(V::along_sv) * length_v +
                             variation_.of_du(V::along_n) * length_n;
    const double longest_v = (1 + variation_.of_dv(V::along_sv)) * length_v + variation_.of_dv(V::along_su) * length_u +
                             variation_.of_dv(V::along_n) * length_n;
    const double reach = longest_u + longest_v;
    hit = {image, distance, reach, true, room};
    return distance - reach > ray.near && distance + reach < far;
  };
  if (any && is_proven()) return Verdict::found;

  Eigen::Vector2d step = image - at;
  for (int i = 0; i < most_steps; ++i) {
    at = D::nearest(at + step);
    ++counters.newton_steps;
    surface = PatchEvaluation<Bezier>(patch_, piece_(at));
    from = surface.position() - origin, du = scale_u * surface.du(), dv = scale_v * surface.dv();
    const auto by_v = values(sums(across_v * from, across_v * du, across_v * dv, none));
    const auto by_u = values(sums(across_u * from, across_u * du, across_u * dv, none));
    g = inverse * Parameter(by_v[0], -by_u[0]);
    image = at - g;
    room = rounding * (most * zeros.farthest(at) + 2 * moved);
    if (!zeros.narrow(image, room)) return Verdict::none;
    if (any && is_proven()) return Verdict::found;
    Eigen::Matrix2d slope;
    slope << inverse * by_v[1], inverse * by_v[2], -inverse * by_u[1], -inverse * by_u[2];
    step = -(slope.inverse() * g);
    constexpr double shortest = 1e-8;  // as in NewtonFinish: the step leaves its square
    if (!(step.squaredNorm() <= shortest * shortest)) continue;
    const Parameter place = at + step;
    if (!D::contains(place, Parameter::Constant(margin))) return Verdict::unknown;
    const double z = values(sums(direction * (from + Four(step.x()) * du + Four(step.y()) * dv), none, none, none))[0];
    if (z < ray.near - error || z > far + (far_is_hit ? -error : error)) return Verdict::none;
    hit = {place, z, 0, true, zero_radius(g, slope, step, contracts, moved)};
    return Verdict::found;
  }
  return Verdict::unknown;
}

}  // namespace shaolin
