#include "tools/stress/aim.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "intersect/corner_disk.h"

namespace shaolin::stress {

namespace {

/// The point at the first place; the normals of all places that are the same point. (Where a non-manifold mesh is cut,
/// faces at one control vertex may part.)
Aim aim_at_places(const Subject& subject, const std::vector<SurfaceParameter>& places, std::size_t first) {
  constexpr std::size_t most = 16;
  const LimitSample sample = subject.evaluate(places[first]);
  Aim aim{places[first], sample.position, true, {sample.normal}, sample.derivatives};
  const std::size_t stride = 1 + places.size() / most;
  for (std::size_t i = stride; i < places.size(); i += stride) {
    const LimitSample other = subject.evaluate(places[(first + i) % places.size()]);
    if ((other.position - sample.position).norm() <= 1e-9 * subject.diagonal()) aim.normals.push_back(other.normal);
  }
  return aim;
}

double random_along(SampleRandom& random) {
  switch (random.index(5)) {
    case 0:
      return 0.5;
    case 1:
      return 1e-3 * random.unit();
    case 2:
      return std::ldexp(static_cast<double>(random.index(1 << 10)), -10);
    case 3:
      return random.log_between(1e-9, 1);
    default:
      return random.unit();
  }
}

}  // namespace

double Aim::cosine(const Vec3& direction) const {
  double least = 1;
  for (const Vec3& normal : normals) least = std::min(least, std::abs(normal.dot(direction)));
  return least;
}

bool Aim::is_crossed(const Vec3& direction) const {
  const auto sign = [&](const Vec3& normal) { return normal.dot(direction) > 0; };
  return std::all_of(normals.begin(), normals.end(), [&](const Vec3& n) { return sign(n) == sign(normals.front()); });
}

Aim aim_at(const Subject& subject, const VertexSite& vertex, SampleRandom& random) {
  Aim aim = aim_at_places(subject, vertex, random.index(vertex.size()));
  // At a sharp corner between smooth edges a face has a normal for each way that leads there.
  constexpr double beside = 0x1p-20;
  const bool triangular = subject.surface().triangular();
  for (std::size_t i = 0; i < std::min<std::size_t>(16, vertex.size()); ++i) {
    const SurfaceParameter& corner = vertex[i];
    const auto [next, last] = sides_at(Parameter(corner.u, corner.v), beside, triangular);
    for (const double share : {0.05, 0.5, 0.95}) {
      const Parameter at = share * next + (1 - share) * last;
      const LimitSample near = subject.evaluate({corner.face, corner.sub, at.x(), at.y()});
      // (A non-manifold mesh is cut.)
      if ((near.position - aim.position).norm() <= 1e-4 * subject.diagonal()) aim.normals.push_back(near.normal);
    }
  }
  return aim;
}

Aim aim_at(const Subject& subject, const EdgeSite& edge, SampleRandom& random) {
  const double along = random_along(random);
  std::vector<SurfaceParameter> places;
  for (const EdgeSite::Side& side : edge.sides) places.push_back(on_edge(subject.surface(), side, along));
  return aim_at_places(subject, places, random.index(places.size()));
}

Aim aim_inside(const Subject& subject, SampleRandom& random) {
  const auto& [face, sub] = pick(subject.sites().pieces, random);
  SurfaceParameter at{face, sub, random.unit(), random.unit()};
  if (subject.surface().triangular() && at.u + at.v > 1) at.u = 1 - at.u, at.v = 1 - at.v;
  const LimitSample sample = subject.evaluate(at);
  return {at, sample.position, false, {sample.normal}, sample.derivatives};
}

Aim aim_anywhere(const Subject& subject, SampleRandom& random) {
  switch (random.index(3)) {
    case 0:
      return aim_at(subject, pick(subject.sites().vertices, random), random);
    case 1:
      return aim_at(subject, pick(subject.sites().edges, random), random);
    default:
      return aim_inside(subject, random);
  }
}

Vec3 direction_at(const Subject& subject, const Aim& aim, SampleRandom& random) {
  const Vec3& normal = aim.normals.front();
  Vec3 direction = Vec3::Zero();
  switch (random.index(6)) {
    case 0:
      direction[static_cast<Eigen::Index>(random.index(3))] = random.one_in(2) ? 1 : -1;
      break;
    case 1:
      direction = random.one_in(2) ? normal : -normal;
      break;
    case 2:
      direction = normal.cross(random.direction()).normalized();
      break;
    case 3:
      direction = (aim.position - aim_anywhere(subject, random).position).stableNormalized();
      break;
    default:
      return random.direction();
  }
  // There may be no normal, and the other aim may be this one.
  return std::abs(direction.norm() - 1) < 1e-9 ? direction : random.direction();
}

Probe probe_at(const Subject& subject, const Aim& aim, const Vec3& direction, double distance, SampleRandom& random) {
  const double length =
      random.one_in(2) ? std::exp2(std::round(random.between(-6, 6))) : random.log_between(0x1p-6, 64);
  const Ray ray{aim.position - distance * direction, length * direction};
  const double cosine = aim.cosine(direction);
  return {ray, Probe::Target{distance / length, cosine, aim.is_crossed(direction)},
          aim.is_shared && cosine < subject.grazing(ray)};
}

Probe probe_at(const Subject& subject, const Aim& aim, const Vec3& direction, SampleRandom& random) {
  return probe_at(subject, aim, direction, random.between(0.5, 3) * subject.diagonal(), random);
}

Vec3 nudged(Vec3 point, SampleRandom& random) {
  for (double& x : point) {
    const std::size_t way = random.index(3);
    if (way > 0) x = std::nextafter(x, way == 1 ? infinity : -infinity);
  }
  return point;
}

}  // namespace shaolin::stress
