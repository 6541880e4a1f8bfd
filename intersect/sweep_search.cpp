#include "sweep_search.h"

#include <algorithm>

#include "quadratic.h"

namespace shaolin {

SweepSearch::SweepSearch(const SphereSweep& sweep, std::optional<double> earliest, const CellFrame& frame,
                         RayCounters& counters)
    : sweep_(sweep),
      frame_(frame),
      counters_(counters),
      earliest_(earliest),
      swept_({sweep.start, sweep.start + earliest.value_or(1) * sweep.displacement}, sweep.radius),
      probe_(swept_, frame, counters) {}

/// Those come first whose places the sphere may reach first, were it as wide as the world.
std::optional<double> SweepSearch::look(const SurfaceCell& cell) {
  if (probe_.is_apart(cell, toward_, margin())) return {};
  const ShapeProbe::Answer answer = probe_(cell, margin());
  if (answer.verdict == ShapeProbe::Verdict::apart) return {};
  if (answer.verdict == ShapeProbe::Verdict::met) improve(cell, *answer.place);
  if (frame_.extent(cell) <= frame_.error() || !may_matter(cell)) return {};
  return frame_.low(cell, sweep_.displacement.normalized());
}

/// |w - t d| = r for the way w from the start to the point: t is where w is along d, less what is left of the radius
/// beside the way across. A point that is farther across than the radius by rounding is touched as it is passed.
std::optional<double> SweepSearch::time_of(const Vec3& point) const {
  const Vec3 &d = sweep_.displacement, way = point - sweep_.start;
  const double length = d.norm(), along = way.dot(d) / length;
  const double across = (way - along / length * d).norm();
  if (across > sweep_.radius + 2 * frame_.error()) return {};
  const double ahead = std::sqrt(std::max(0.0, (sweep_.radius - across) * (sweep_.radius + across)));
  const double t = std::max(0.0, (along - ahead) / length);
  const double limit = earliest_.value_or(1);
  if (t <= limit) return t;
  // At the very end of the way, contact to rounding is contact.
  if (!earliest_ && (point - sweep_.start - d).norm() <= sweep_.radius + 2 * frame_.error()) return limit;
  return {};
}

void SweepSearch::take(const SurfaceCell& cell, const Moment& moment) {
  if (earliest_ && !(moment.t < *earliest_)) return;
  earliest_ = moment.t;
  found_ = Found{&cell, moment.place.own, moment.t};
  const Vec3 centre = sweep_.start + moment.t * sweep_.displacement;
  toward_ = moment.place.position - centre;
  swept_ = Simplex({sweep_.start, centre}, sweep_.radius);
}

/// Steps that make the time shorter, halved where they lead too far.
void SweepSearch::improve(const SurfaceCell& cell, const FramedSample& from) {
  const std::optional<double> first = time_of(from.position);
  if (!first) return;
  Moment best{from, *first};
  constexpr int most_steps = 16, most_halvings = 4;
  for (int i = 0; i < most_steps && best.place.derivatives; ++i) {
    Parameter next = step(cell, best);
    bool is_earlier = false;
    for (int k = 0; k < most_halvings && !is_earlier && next != best.place.own.at; ++k) {
      ++counters_.newton_steps;
      const FramedSample there = *frame_.sample(cell, next);
      const std::optional<double> t = time_of(there.position);
      is_earlier = t && *t < best.t;
      if (is_earlier)
        best = {there, *t};
      else
        next = 0.5 * (next + best.place.own.at);
    }
    if (!is_earlier) break;
  }
  polish(cell, best);
  take(cell, best);
}

/// At its least the time changes with the square of a step, so that it is known to rounding when the place is known to
/// half the digits. One more step wins the others, as long as the sphere touches there at the same time.
void SweepSearch::polish(const SurfaceCell& cell, Moment& moment) const {
  if (!moment.place.derivatives) return;
  const FramedSample there = *frame_.sample(cell, step(cell, moment));
  const Vec3 centre = sweep_.start + moment.t * sweep_.displacement;
  if (std::abs((there.position - centre).norm() - sweep_.radius) <= frame_.error()) moment.place = there;
}

/// The time is a function of the parameters by psi = (|w|^2 - r^2) / 2 = 0 with w = S - start - t d: with indices for
/// derivatives, t_a = w . S_a / w . d and
///   t_ab w . d = S_a . S_b + w . S_ab - d . S_a t_b - d . S_b t_a + d . d t_a t_b.
/// Where the function of second degree with these is least in the cell is the next place.
Parameter SweepSearch::step(const SurfaceCell& cell, const Moment& from) const {
  const Vec3& d = sweep_.displacement;
  const Derivatives& s = *from.place.derivatives;
  const Vec3 w = from.place.position - sweep_.start - from.t * d;
  const double ahead = w.dot(d);
  // The sphere slides along what it touches sideways: no step is known to be good.
  constexpr double least = 1e-9;
  if (!(ahead > least * w.norm() * d.norm())) return from.place.own.at;
  const Eigen::Vector2d t(w.dot(s.du) / ahead, w.dot(s.dv) / ahead), along(d.dot(s.du), d.dot(s.dv));
  const auto second = [&](const Vec3& a, const Vec3& b, const Vec3& ab, Eigen::Index i, Eigen::Index j) {
    return (a.dot(b) + w.dot(ab) - along[i] * t[j] - along[j] * t[i] + d.squaredNorm() * t[i] * t[j]) / ahead;
  };
  const Quadratic time{
      from.place.own.at,
      t,
      {second(s.du, s.du, s.duu, 0, 0), second(s.du, s.dv, s.duv, 0, 1), second(s.dv, s.dv, s.dvv, 1, 1)}};
  return cell.is_triangular() ? lowest<Domain<FaceKind::triangle>>(time).at : lowest<Domain<FaceKind::quad>>(time).at;
}

}  // namespace shaolin
