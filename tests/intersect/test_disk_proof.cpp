// Certificates of hits where patches meet.
#include <algorithm>

#include "intersect/scene.h"
#include "schemes/domain.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/meshes.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

namespace {

/// A place at an edge or a vertex of a face.
SurfaceParameter draw_place(const LimitSurface& surface, Random& random) {
  int face = 0;
  do face = random.index(surface.face_count());
  while (!surface.has_limit(face));
  const double along = random.index(3) == 0 ? 0 : random.index(2) == 0 ? 0.5 : random.uniform();
  const int sub = random.index(surface.sub_count(face));
  return random.index(2) == 0 ? SurfaceParameter{face, sub, along, 0} : SurfaceParameter{face, sub, 0, along};
}

/// The least cosine of the normals around a point with one of them, as sides turn to the viewer: below 0 if they do not
/// all turn the same way. Normals beside the point count: at a vertex a face may have many.
double least_cosine(const LimitSurface& surface, const PointPlaces& places, const Vec3& direction) {
  double least = 1, most = -1;
  const Parameter middle = surface.triangular() ? Parameter(1.0 / 3, 1.0 / 3) : Parameter(0.5, 0.5);
  for (const SurfaceParameter& at : places.all)
    for (const double beside : {0.0, 1e-6, 1e-3}) {
      const Parameter p = (1 - beside) * Parameter(at.u, at.v) + beside * middle;
      const auto sample = surface.evaluate({at.face, at.sub, p.x(), p.y()});
      const double cosine = sample->normal.dot(direction);
      least = std::min(least, cosine);
      most = std::max(most, cosine);
    }
  return std::max(least, -most);
}

}  // namespace

TEST_CASE("Hits at edges, creases and vertices are certified by disks, boundaries and outlines are not",
          "[intersect][disk_proof]") {
  std::size_t proven = 0, asked = 0, open = 0, outlines = 0;
  for (const Model& model : all_models()) {
    // Two sheets end in one point there, and nothing is an immersion.
    if (model.name.find("val2") != std::string::npos) continue;
    INFO(model.name);
    const Scene scene(model.mesh, model.scheme);
    const LimitSurface& surface = scene.surface();
    const double size = model.mesh.diagonal();
    Random random(5);
    for (int i = 0; i < 60; ++i) {
      const SurfaceParameter at = draw_place(surface, random);
      const Vec3 point = surface.evaluate(at)->position, direction = random.direction();
      const Ray ray{point - 0.25 * size * direction, direction, 0.25 * size * (1 - 1e-9), infinity};
      const std::optional<Hit> hit = scene.intersect(ray);
      const PointPlaces places = surface.places_of(at);
      const double cosine = least_cosine(surface, places, direction);
      if (!hit || hit->t > 0.25 * size * (1 + 1e-9)) continue;
      const Certificate certificate = scene.certify(ray, *hit);
      INFO(at.face << ' ' << at.sub << ' ' << at.u << ' ' << at.v << " cosine " << cosine);
      if (!places.is_closed) {
        ++open;
        CHECK_FALSE(certificate.is_certified());
      } else if (cosine < -0.1) {
        ++outlines;
        CHECK_FALSE(certificate.is_certified());
      } else if (cosine > 0.3) {
        ++asked;
        proven += certificate.is_certified();
      }
      if (certificate.is_certified()) {
        CHECK(certificate.error <= 1e-8 * size);
        CHECK((hit->sample.position - point).norm() <= certificate.error);
      }
    }
  }
  CHECK(open > 100);
  CHECK(outlines > 20);
  CHECK(asked > 1000);
  INFO(proven << " of " << asked);
  CHECK(static_cast<double>(proven) >= 0.99 * static_cast<double>(asked));
}

TEST_CASE("A hit that is none has no certificate that holds", "[intersect][disk_proof]") {
  const Scene scene(torus("catmark", 5, 7), "catmark");
  const LimitSurface& surface = scene.surface();
  const double size = (scene.bounds().upper - scene.bounds().lower).norm();
  Random random(7);
  int moved = 0, beside = 0;
  for (int i = 0; i < 100; ++i) {
    const SurfaceParameter at = draw_place(surface, random);
    const LimitSample sample = *surface.evaluate(at);
    const Ray through{sample.position - size * sample.normal, sample.normal, -infinity, infinity};
    Hit planted;
    planted.t = size;
    planted.at = at;
    planted.sample = sample;
    REQUIRE(scene.certify(through, planted).is_certified());
    // Said to be elsewhere than the ray meets the surface: the error covers it.
    planted.sample.position += 1e-3 * size * random.direction();
    const Certificate certificate = scene.certify(through, planted);
    if (certificate.is_certified()) {
      ++moved;
      CHECK(certificate.error >= 0.999e-3 * size);
    }
    // The ray passes the place by far, or runs in its tangent plane.
    planted.sample.position = sample.position;
    const Vec3 across = sample.normal.unitOrthogonal();
    const Ray by{through.origin + size * across, sample.normal, -infinity, infinity};
    const Ray along{sample.position - size * across, across, -infinity, infinity};
    for (const Ray& ray : {by, along}) {
      beside += scene.certify(ray, planted).is_certified();
    }
  }
  CHECK(moved > 50);
  CHECK(beside == 0);
}

TEST_CASE("The tip of a sharp cube: certified from above, not along an edge seen as an outline",
          "[intersect][disk_proof]") {
  const Scene scene(cube(), "bilinear");
  const auto certificate = [&](const Vec3& through, const Vec3& direction) {
    const Ray ray{through - direction, direction, 0.5, infinity};
    const std::optional<Hit> hit = scene.intersect(ray);
    REQUIRE(hit);
    return scene.certify(ray, *hit);
  };
  const Box box = scene.bounds();
  const Vec3 tip = box.upper, middle(0.5 * (box.lower.x() + box.upper.x()), box.upper.y(), box.upper.z());
  CHECK(certificate(tip, Vec3(-1, -1, -1)).is_certified());
  CHECK(certificate(tip, Vec3(-0.2, -0.5, -1)).is_certified());
  CHECK(certificate(middle, Vec3(-0.1, -1, -1)).is_certified());
  CHECK_FALSE(certificate(tip, Vec3(1, -1, -1)).is_certified());
  CHECK_FALSE(certificate(middle, Vec3(0, 1, -1)).is_certified());
  CHECK(certificate(tip, Vec3(-1, -1, -1)).error < 1e-10);
}

TEST_CASE("Certificates of instances are in the world's lengths, and bad questions are refused",
          "[intersect][disk_proof]") {
  const auto object = make_object(torus("catmark", 5, 7), "catmark");
  Affine map = Affine::Identity();
  map.linear() = 100 * Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  map.translation() = Vec3(3, -5, 7);
  const Scene plain({{object}}), moved({{object}, {object, map}});
  const LimitSample sample = *object->surface().evaluate({3, 0, 0.5, 0});
  const Ray ray{sample.position + sample.normal, -sample.normal, 0.5, 1.5};
  const Ray there{map * ray.origin, map.linear() * ray.direction, 0.5, 1.5};
  Hit hit = *plain.intersect(ray), far = *moved.intersect(there);
  REQUIRE(far.instance == 1);
  hit.certificate = far.certificate = {};
  const Certificate here = plain.certify(ray, hit), away = moved.certify(there, far);
  REQUIRE(here.is_certified());
  REQUIRE(away.is_certified());
  CHECK(away.error > 50 * here.error);
  CHECK(away.error < 1e-8);

  hit.instance = 1;
  CHECK_THROWS_AS(plain.certify(ray, hit), InputError);
  hit.instance = 0;
  hit.at.face = 35;
  CHECK_THROWS_AS(plain.certify(ray, hit), InputError);
  hit.at = {3, 0, infinity, 0};
  CHECK_THROWS_AS(plain.certify(ray, hit), InputError);
  hit.at = {3, 0, 0.5, 0};
  CHECK_THROWS_AS(plain.certify({ray.origin, Vec3::Zero()}, hit), InputError);
  SceneOptions options;
  options.method = Method::chord;
  const Scene chord(torus("catmark", 5, 7), "catmark", options);
  CHECK_FALSE(chord.certify(ray, hit).is_certified());
}

}  // namespace shaolin
