#include "shape_probe.h"

#include <algorithm>

#include "quadratic.h"

namespace shaolin {

namespace {

/// N^T (S_u, S_v), with rows of zeros for what is not normal.
Eigen::Matrix<double, 3, 2> slopes_of(const Derivatives& d, const Convex::Nearest& core) {
  Eigen::Matrix<double, 3, 2> slopes;
  slopes << core.normals.transpose() * d.du, core.normals.transpose() * d.dv;
  for (Eigen::Index i = core.rank; i < 3; ++i) slopes.row(i).setZero();
  return slopes;
}

}  // namespace

auto ShapeProbe::gap(const Vec3& point) const -> Gap {
  Gap gap{shape_.nearest(point), Vec3::Zero(), 0};
  gap.way = point - gap.core.point;
  gap.distance = gap.way.norm() - shape_.radius();
  return gap;
}

Vec3 ShapeProbe::on_shape(const Vec3& point) const {
  const Gap there = gap(point);
  if (there.distance <= 0) return point;
  return there.core.point + shape_.radius() * there.way.normalized();
}

bool ShapeProbe::is_apart(const SurfaceCell& cell, const Vec3& way, double margin) const {
  const double length = way.norm();
  if (!(length > 0)) return false;
  ++counters_.hull_tests;
  const Vec3 n = way / length;
  return frame_.low(cell, n) - shape_.support(n) - shape_.radius() > margin;
}

bool ShapeProbe::is_apart_along_sides(const SurfaceCell& cell, double margin) const {
  const std::vector<Vec3>& sides = shape_.sides();
  return std::any_of(sides.begin(), sides.end(), [&](const Vec3& side) { return is_apart(cell, side, margin); });
}

bool ShapeProbe::is_beside(const SurfaceCell& cell, const FramedSample& nearest, double margin) const {
  const std::optional<Convex::Flat> flat = shape_.flat();
  return flat && frame_.least_length(cell, flat->across, flat->point, nearest.own.at) - shape_.radius() > margin;
}

/// The step solves N^T (S - q) = 0, with q the core's nearest point and N what is normal to the core there: one
/// equation over a side, two over an edge, three in a corner. So where the surface crosses a side or an edge steps
/// converge quadratically. (They lead to the core of a rounded shape, through what is around it.) Two or three
/// equations are solved by least squares; one, or what has no single solution, by the shortest step that makes up for
/// the distance.
std::optional<Parameter> ShapeProbe::step_across(const SurfaceCell& cell, const FramedSample& from,
                                                 const Gap& gap) const {
  const Eigen::Matrix<double, 3, 2> slopes = slopes_of(*from.derivatives, gap.core);
  const Eigen::Matrix2d gram = slopes.transpose() * slopes;
  Eigen::Vector2d change;
  if (gap.core.rank > 1 && gram.determinant() > unit_roundoff * gram.trace() * gram.trace()) {
    change = -gram.inverse() * (slopes.transpose() * (gap.core.normals.transpose() * gap.way));
  } else {
    const Eigen::Vector2d slope(from.derivatives->du.dot(gap.way), from.derivatives->dv.dot(gap.way));
    change = -gap.distance * gap.way.norm() / slope.squaredNorm() * slope;
  }
  if (!change.allFinite()) return {};
  const Parameter to = from.own.at + change;
  return cell.is_triangular() ? Domain<FaceKind::triangle>::nearest(to) : Domain<FaceKind::quad>::nearest(to);
}

/// Half the squared distance from the core has the gradient w . S_a, with the way w = S - q, and the second derivatives
/// N^T S_a . N^T S_b + w . S_ab. The function of second degree with these is least in the cell at the next place, be it
/// on a side or in a corner.
Parameter ShapeProbe::step_near(const SurfaceCell& cell, const FramedSample& from, const Gap& gap) const {
  const Derivatives& d = *from.derivatives;
  const Eigen::Matrix<double, 3, 2> slopes = slopes_of(d, gap.core);
  const Eigen::Matrix2d gram = slopes.transpose() * slopes;
  const Quadratic squared{
      from.own.at,
      {gap.way.dot(d.du), gap.way.dot(d.dv)},
      {gram(0, 0) + gap.way.dot(d.duu), gram(0, 1) + gap.way.dot(d.duv), gram(1, 1) + gap.way.dot(d.dvv)}};
  return cell.is_triangular() ? lowest<Domain<FaceKind::triangle>>(squared).at
                              : lowest<Domain<FaceKind::quad>>(squared).at;
}

/// By the first step of the two that leads nearer to the shape; false if neither does.
bool ShapeProbe::approach(const SurfaceCell& cell, FramedSample& place, Gap& now) const {
  for (const bool across : {true, false}) {
    const std::optional<Parameter> next = across ? step_across(cell, place, now) : step_near(cell, place, now);
    if (!next || *next == place.own.at) continue;
    ++counters_.newton_steps;
    const FramedSample there = *frame_.sample(cell, *next);
    const Gap then = gap(there.position);
    if (!(then.distance < now.distance)) continue;
    place = there;
    now = then;
    return true;
  }
  return false;
}

auto ShapeProbe::operator()(const SurfaceCell& cell, double margin) const -> Answer {
  const Parameter centre =
      cell.is_triangular() ? Domain<FaceKind::triangle>::centre() : Domain<FaceKind::quad>::centre();
  std::optional<FramedSample> place = frame_.sample(cell, centre);
  Gap now = gap(place ? place->position : frame_(cell.box().centre()));
  if (is_apart(cell, now.way, margin) || is_apart_along_sides(cell, margin)) return {Verdict::apart, now.distance, {}};
  if (!place || !place->derivatives) {
    for (const Vec3& side : frame_.sides())
      if (is_apart(cell, side, margin) || is_apart(cell, -side, margin)) return {Verdict::apart, now.distance, {}};
  }
  if (!place) return {Verdict::open, now.distance, {}};
  const double near = 2 * frame_.error();
  if (now.distance <= near || frame_.extent(cell) <= frame_.error()) return {Verdict::met, now.distance, place};
  if (!place->derivatives) return {Verdict::open, now.distance, place};
  const Vec3 normal = place->derivatives->du.cross(place->derivatives->dv);
  if (is_apart(cell, normal, margin) || is_apart(cell, -normal, margin)) return {Verdict::apart, now.distance, {}};
  constexpr int most_steps = 8;
  for (int i = 0; i < most_steps && approach(cell, *place, now); ++i)
    if (now.distance <= near) return {Verdict::met, now.distance, place};
  if (is_apart(cell, now.way, margin) || is_beside(cell, *place, margin)) return {Verdict::apart, now.distance, {}};
  return {Verdict::open, now.distance, place};
}

}  // namespace shaolin
