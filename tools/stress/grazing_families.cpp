/// Rays that come in flat: at angles down to 1e-8 degrees, within tangent planes, along parameter lines, at outlines.
#include <cmath>
#include <numbers>

#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

/// A unit vector across a normal; any direction where there is none.
Vec3 tangent_to(const Vec3& normal, SampleRandom& random) {
  const Vec3 tangent = normal.cross(random.direction()).stableNormalized();
  return tangent.norm() > 0.5 ? tangent : random.direction();
}

Probe grazing_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = random.one_in(4) ? aim_anywhere(subject, random) : aim_inside(subject, random);
  const Vec3& normal = aim.normals.front();
  const double angle = random.log_between(1e-8, 90) * std::numbers::pi / 180;
  const Vec3 side = random.one_in(2) ? normal : -normal;
  const Vec3 direction = std::cos(angle) * tangent_to(normal, random) + std::sin(angle) * side;
  return probe_at(subject, aim, direction.normalized(), random);
}

Probe tangent_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_anywhere(subject, random);
  return probe_at(subject, aim, tangent_to(aim.normals.front(), random), random);
}

/// Along du or dv, or from one end of an edge to the other: within the surface where that is straight.
Probe isoparametric_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_inside(subject, random);
  Vec3 direction = Vec3::Zero();
  if (random.one_in(3)) {
    const EdgeSite::Side& side = pick(pick(subject.sites().edges, random).sides, random);
    direction = subject.evaluate(on_edge(subject.surface(), side, 1)).position -
                subject.evaluate(on_edge(subject.surface(), side, 0)).position;
  } else if (aim.derivatives) {
    direction = random.one_in(2) ? aim.derivatives->du : aim.derivatives->dv;
  }
  direction.stableNormalize();
  return probe_at(subject, aim, std::abs(direction.norm() - 1) < 1e-9 ? direction : random.direction(), random);
}

/// A section of the surface by the plane of its normal and a tangent: how parameters change along it, per length, and
/// its curvature, positive where it turns to the normal's side.
struct Section {
  Eigen::Vector2d way;
  double curvature;

  Section(const Derivatives& d, const Vec3& normal, const Vec3& tangent) {
    Eigen::Matrix2d metric;
    metric << d.du.dot(d.du), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.dot(d.dv);
    way = metric.inverse() * Eigen::Vector2d(d.du.dot(tangent), d.dv.dot(tangent));
    curvature = normal.dot(d.duu) * way.x() * way.x() + 2 * normal.dot(d.duv) * way.x() * way.y() +
                normal.dot(d.dvv) * way.y() * way.y();
  }
};

/// A ray that misses being tangent by a depth, on the side to which the surface turns: a double root that has become
/// two, at s = sqrt(2 depth / curvature) before and behind the point of contact. That the first is there is known
/// without a ray: the height of the surface over its tangent plane is 0 at the point of contact, and evaluated 2 s
/// before it at least twice the depth (about four times; it stays on one smooth patch, and leaves the plane of the
/// section by a part of s, which is at most 1.5e-3 of the radius of curvature).
Probe silhouette_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_inside(subject, random);
  const Vec3 direction = tangent_to(aim.normals.front(), random);
  Probe probe = probe_at(subject, aim, direction, random);
  if (!aim.derivatives || random.one_in(4)) return probe;
  const Section section(*aim.derivatives, aim.normals.front(), direction);
  const Vec3 inward = section.curvature > 0 ? aim.normals.front() : -aim.normals.front();
  const double depth = random.log_between(1e-12, 1e-6) / std::abs(section.curvature);
  if (!(depth < subject.magnitude(probe.ray))) return probe;  // flat: no double root
  probe.ray.origin += depth * inward;
  probe.target.reset();
  const double back = 2 * std::sqrt(2 * depth / std::abs(section.curvature));
  const double u = aim.at.u - back * section.way.x(), v = aim.at.v - back * section.way.y();
  const double far = subject.surface().triangular() ? u + v : std::max(u, v);
  if (!(std::min(u, v) >= 0 && far <= 1)) return probe;
  // The surface goes on beside the ray as well: how high it is at the ray its slope says, to first order.
  const LimitSample behind = subject.evaluate({aim.at.face, aim.at.sub, u, v});
  const Vec3 offset = behind.position - aim.position, side = direction.cross(inward);
  const double slope = std::abs(behind.normal.dot(side) / behind.normal.dot(inward));
  const double height = offset.dot(inward) - 2 * slope * std::abs(offset.dot(side));
  // Below sixteen times the bound of rounding it may be a matter of rounding whether there are roots.
  if (height >= 2 * depth && depth > 16 * subject.rounding(probe.ray)) {
    const double t = (aim.position - probe.ray.origin).dot(direction) / probe.ray.direction.dot(direction);
    probe.target = Probe::Target{.t = t, .cosine = 1, .is_crossed = false, .is_exact = false};
  }
  return probe;
}

Family family_of(const std::string& name, const std::string& meaning, Probe (*draw)(const Subject&, SampleRandom&)) {
  const auto stage = [=](const StressModel& model, const QueriesOf& queries) {
    return probe_stage(name, std::make_unique<const Subject>(model, queries), draw);
  };
  return {name, meaning, stage};
}

}  // namespace

std::vector<Family> grazing_families() {
  return {
      family_of("grazing", "at angles of 90 to 1e-8 degrees against the surface", grazing_probe),
      family_of("tangent", "within tangent planes", tangent_probe),
      family_of("isoparametric", "along parameter lines and chords of edges", isoparametric_probe),
      family_of("silhouettes", "beside double roots, by 1e-12 to 1e-6 of the radius of curvature", silhouette_probe)};
}

}  // namespace shaolin::stress
