#include "tools/validate/sampling.h"

#include <algorithm>
#include <cmath>

#include "tools/validate/random.h"

namespace shaolin {
namespace {

/// A face with a limit surface, or a corner of one.
struct SampledPiece {
  int face, sub;
};

std::vector<SampledPiece> pieces_of(const SampledSurface& surface) {
  std::vector<SampledPiece> pieces;
  for (int face = 0; face < surface.face_count; ++face) {
    for (int sub = 0; surface.has_limit(face) && sub < surface.sub_count(face); ++sub) pieces.push_back({face, sub});
  }
  return pieces;
}

SurfaceParameter random_parameter(const SampledPiece& piece, bool triangular, SampleRandom& random) {
  SurfaceParameter at{piece.face, piece.sub, random.unit(), random.unit()};
  if (triangular && at.u + at.v > 1) at.u = 1 - at.u, at.v = 1 - at.v;
  return at;
}

/// At `distance` from a corner of the domain: on the square's, or triangle's, far sides, shrunk towards it. Only the
/// origin has parameters that are closer to it than a rounding of 1 and yet in the triangle.
SurfaceParameter near_corner(const SampledPiece& piece, bool triangular, double distance, double along,
                             SampleRandom& random) {
  SurfaceParameter at{piece.face, piece.sub, 0, 0};
  if (triangular) {
    // Barycentric: 1 - distance for the corner, the rest shared.
    const double share = distance * along, rest = distance - share;
    switch (1 - distance < 1 || distance == 0 ? random.index(3) : 0) {
      case 0:
        at.u = share, at.v = rest;
        break;
      case 1:
        at.v = share, at.u = 1 - distance;
        break;
      default:
        at.u = share, at.v = 1 - distance;
        break;
    }
    at.v = std::min(at.v, 1 - at.u);
    return at;
  }
  double du = distance, dv = distance * along;
  if (random.one_in(2)) std::swap(du, dv);
  at.u = random.one_in(2) ? du : 1 - du;
  at.v = random.one_in(2) ? dv : 1 - dv;
  return at;
}

SurfaceParameter crowding_parameter(const SampledPiece& piece, bool triangular, SampleRandom& random) {
  const double distance = random.log_between(1e-8, 1), along = random.unit();
  switch (random.index(16)) {
    case 0:
      return near_corner(piece, triangular, 0, along, random);
    case 1:
      return near_corner(piece, triangular, distance, random.one_in(2) ? 0 : triangular, random);
    case 2:
      return near_corner(piece, triangular, random.log_between(1e-35, 1e-8), along, random);
    default:
      return near_corner(piece, triangular, distance, along, random);
  }
}

/// The surface's box, and its diagonal as the length unit.
struct Surroundings {
  Vec3 lower, upper;
  double diagonal;

  Vec3 centre() const { return (lower + upper) / 2; }
};

/// From the corners and a point inside of each piece.
Surroundings surroundings_of(const SampledSurface& surface, const std::vector<SampledPiece>& pieces) {
  constexpr double places[][2] = {{0, 0}, {1, 0}, {0, 1}, {0.3125, 0.3125}};
  Vec3 lower = surface.evaluate({pieces[0].face, pieces[0].sub, 0, 0})->position, upper = lower;
  for (const SampledPiece& piece : pieces) {
    for (const auto& [u, v] : places) {
      const Vec3 point = surface.evaluate({piece.face, piece.sub, u, v})->position;
      lower = lower.cwiseMin(point);
      upper = upper.cwiseMax(point);
    }
  }
  return {lower, upper, (upper - lower).norm()};
}

ProbeRay camera_ray(const Surroundings& model, SampleRandom& random) {
  const Vec3 eye = model.centre() + random.between(0.7, 3) * model.diagonal * random.direction();
  return {RayKind::camera, {eye, random.inside(model.lower, model.upper) - eye}, {}};
}

ProbeRay incoherent_ray(const Surroundings& model, SampleRandom& random) {
  const Vec3 margin = 0.25 * (model.upper - model.lower) + Vec3::Constant(0.05 * model.diagonal);
  Ray ray{random.inside(model.lower - margin, model.upper + margin), random.direction()};
  if (random.one_in(4)) {
    ray.tmin = random.between(-0.5, 0.5) * model.diagonal;
    ray.tmax = ray.tmin + random.between(0, 2) * model.diagonal;
  }
  return {RayKind::incoherent, ray, {}};
}

/// The origin lies `distance` before the point, so that the ray meets it at t = 1.
ProbeRay ray_through(RayKind kind, const SampledSurface& surface, const SurfaceParameter& at, const LimitSample& sample,
                     const Vec3& direction, double distance) {
  const bool crosses = surface.is_inside(at) && std::abs(direction.dot(sample.normal)) > 1e-2;
  return {kind, {sample.position - distance * direction, distance * direction}, 1.0, crosses};
}

ProbeRay grazing_ray(const SampledSurface& surface, const SampledPiece& piece, const Surroundings& model,
                     SampleRandom& random) {
  const SurfaceParameter at = random_parameter(piece, surface.triangular, random);
  const LimitSample sample = *surface.evaluate(at);
  const Vec3 tangent = sample.normal.cross(random.direction()).normalized();
  const double tilt = random.log_between(1e-4, 1e-1) * (random.one_in(2) ? 1 : -1);
  const Vec3 direction = std::cos(tilt) * tangent + std::sin(tilt) * sample.normal;
  // No tangent plane: any direction will do.
  const Vec3 usable = direction.norm() > 0.5 ? direction.normalized() : random.direction();
  return ray_through(RayKind::grazing, surface, at, sample, usable, random.log_between(1e-2, 3) * model.diagonal);
}

ProbeRay aimed_ray(const SampledSurface& surface, const SampledPiece& piece, const Surroundings& model,
                   SampleRandom& random) {
  const bool at_corner = random.one_in(2);
  const double side = surface.triangular && random.one_in(2) ? 1 : 0;
  const SurfaceParameter at = near_corner(piece, surface.triangular, at_corner ? 0 : random.unit(), side, random);
  return ray_through(RayKind::aimed, surface, at, *surface.evaluate(at), random.direction(),
                     random.log_between(1e-2, 3) * model.diagonal);
}

}  // namespace

SampledSurface SampledSurface::of(const Oracle& oracle) {
  return {.face_count = oracle.face_count(),
          .triangular = oracle.triangular(),
          .has_limit = [&](int face) { return oracle.has_limit(face); },
          .sub_count = [&](int face) { return oracle.sub_count(face); },
          .evaluate = [&](const SurfaceParameter& at) { return oracle.evaluate(at); },
          .is_inside = [&](const SurfaceParameter& at) { return oracle.is_inside(at); }};
}

SampledSurface SampledSurface::of(const LimitSurface& surface) {
  return {.face_count = surface.face_count(),
          .triangular = surface.triangular(),
          .has_limit = [&](int face) { return surface.has_limit(face); },
          .sub_count = [&](int face) { return surface.sub_count(face); },
          .evaluate = [&](const SurfaceParameter& at) { return surface.evaluate(at); },
          .is_inside = [](const SurfaceParameter&) { return false; }};
}

std::vector<SurfaceParameter> sample_parameters(const Oracle& oracle, std::size_t count, std::uint64_t seed) {
  const std::vector<SampledPiece> pieces = pieces_of(SampledSurface::of(oracle));
  std::vector<SurfaceParameter> parameters;
  if (pieces.empty()) return parameters;
  SampleRandom random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    const SampledPiece& piece = pieces[random.index(pieces.size())];
    parameters.push_back(i % 4 == 3 ? crowding_parameter(piece, oracle.triangular(), random)
                                    : random_parameter(piece, oracle.triangular(), random));
  }
  return parameters;
}

const char* name_of(RayKind kind) {
  switch (kind) {
    case RayKind::camera:
      return "camera";
    case RayKind::incoherent:
      return "incoherent";
    case RayKind::grazing:
      return "grazing";
    case RayKind::aimed:
      break;
  }
  return "aimed";
}

std::vector<ProbeRay> sample_rays(const SampledSurface& surface, std::size_t count, std::uint64_t seed) {
  const std::vector<SampledPiece> pieces = pieces_of(surface);
  std::vector<ProbeRay> rays;
  if (pieces.empty()) return rays;
  const Surroundings model = surroundings_of(surface, pieces);
  SampleRandom random(seed);
  for (std::size_t i = 0; i < count + count / 10; ++i) {
    const RayKind kind = i < count ? ray_kinds[i % 3] : RayKind::aimed;
    const SampledPiece& piece = pieces[random.index(pieces.size())];
    ProbeRay probe = kind == RayKind::camera       ? camera_ray(model, random)
                     : kind == RayKind::incoherent ? incoherent_ray(model, random)
                     : kind == RayKind::grazing    ? grazing_ray(surface, piece, model, random)
                                                   : aimed_ray(surface, piece, model, random);
    const double length = random.log_between(1e-2, 1e2);
    probe.ray.direction *= length;
    probe.ray.tmin /= length;
    probe.ray.tmax /= length;
    if (probe.target) *probe.target /= length;
    rays.push_back(probe);
  }
  return rays;
}

std::vector<ProbeRay> sample_rays(const Oracle& oracle, std::size_t count, std::uint64_t seed) {
  return sample_rays(SampledSurface::of(oracle), count, seed);
}

}  // namespace shaolin
