// What a ray may be: its interval, the length of its direction, and the rays that are errors.
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The plane z = 0 over [0, 4]^2.
Scene plane() { return Scene(sheet("catmark", 4, 4), "catmark"); }

/// Down on the plane, which it meets at t = 2.
Ray down(double tmin = 0, double tmax = infinity) { return {{1.3, 2.6, 2}, {0, 0, -1}, tmin, tmax}; }

/// The t of all crossings, each found by starting just past the one before.
std::vector<double> crossings(const Scene& scene, Ray ray, double gap) {
  std::vector<double> result;
  while (const auto hit = scene.intersect(ray)) {
    result.push_back(hit->t);
    ray.tmin = hit->t + gap;
    if (result.size() > 100) break;
  }
  return result;
}

}  // namespace

TEST_CASE("The interval of a ray includes its ends", "[intersect][scene]") {
  const Scene scene = plane();
  REQUIRE(scene.intersect(down()));
  const double t = scene.intersect(down())->t;
  CHECK(t == Approx(2).epsilon(1e-14));
  // Rounding may move a hit by some 1e-13 here, across the interval's end as well: 1e-9 is outside for certain.
  for (const auto& [tmin, tmax, met] : {std::tuple{t, infinity, true},
                                        {0.0, t, true},
                                        {t, t, true},
                                        {t + 1e-9, infinity, false},
                                        {0.0, t - 1e-9, false},
                                        {t - 1e-9, t + 1e-9, true},
                                        {3.0, 1.0, false},
                                        {infinity, infinity, false},
                                        {-infinity, infinity, true},
                                        {-infinity, 0.0, false},
                                        {-infinity, -infinity, false}}) {
    CAPTURE(tmin, tmax);
    const auto hit = scene.intersect(down(tmin, tmax));
    CHECK(hit.has_value() == met);
    CHECK(scene.occluded(down(tmin, tmax)) == met);
    if (hit) CHECK((hit->t >= tmin && hit->t <= tmax));
  }
}

TEST_CASE("A negative tmin finds what lies behind the origin", "[intersect][scene]") {
  const Scene scene = plane();
  const Ray ray{{1.3, 2.6, -2}, {0, 0, -1}, -3, infinity};
  REQUIRE(scene.intersect(ray));
  CHECK(scene.intersect(ray)->t == Approx(-2).epsilon(1e-14));
}

TEST_CASE("A line crosses a closed surface an even number of times, the same from both ends", "[intersect][scene]") {
  const std::vector<Model> closed{{"torus", "catmark", shaken(torus("catmark", 5, 8), 0.1)},
                                  {"torus", "loop", shaken(torus("loop", 5, 8), 0.1)},
                                  {"poles", "catmark", shaken(poles("catmark", 6), 0.2)},
                                  {"poles", "loop", shaken(poles("loop", 3), 0.2)},
                                  {"prism", "catmark", shaken(prism(5), 0.1)}};
  for (const Model& model : closed) {
    CAPTURE(model.name, model.scheme);
    const Scene scene(model.mesh, model.scheme);
    int crossed = 0;
    for (const Ray& ray : random_rays(scene.bounds(), 600, 21)) {
      const double gap = 1e-9;  // in units of t; no two crossings of these random rays are as near
      const std::vector<double> there = crossings(scene, ray, gap);
      std::vector<double> back = crossings(scene, {ray.origin + 5 * ray.direction, -ray.direction, 0, infinity}, gap);
      std::reverse(back.begin(), back.end());
      CAPTURE(ray.origin.transpose(), ray.direction.transpose());
      CHECK(there.size() % 2 == 0);
      REQUIRE(there.size() == back.size());
      for (std::size_t i = 0; i < there.size(); ++i) CHECK(std::abs(there[i] - (5 - back[i])) < 1e-10);
      crossed += there.size() > 2;
    }
    if (model.name == "torus") CHECK(crossed > 20);
  }
}

TEST_CASE("A hit whose t overflows is none", "[intersect][scene]") {
  const Scene scene = plane();
  for (const double length : {1e-308, 1e-310, 5e-324}) {
    CAPTURE(length);
    const Ray ray{{1.3, 2.6, 2}, {0, 0, -length}};  // t would be 2 / length
    CHECK(!scene.intersect(ray));
    CHECK(!scene.occluded(ray));
  }
  const auto near = scene.intersect({{1.3, 2.6, 0x1p-100}, {0, 0, -0x1p-1060}});
  REQUIRE(near);
  CHECK(near->t == Approx(0x1p960));
}

TEST_CASE("t is in units of the direction's length", "[intersect][scene]") {
  const Scene scene(shaken(poles("loop", 5), 0.1), "loop");
  for (const Ray& ray : random_rays(scene.bounds(), 100, 22)) {
    const auto hit = scene.intersect(ray);
    // Powers of two round nothing; others turn the unit direction by an ulp.
    for (const double factor : {0x1p-1000, 0x1p-3, 0x1p900, 3.0, 1e-290, 1e290}) {
      CAPTURE(factor);
      Ray scaled = ray;
      scaled.direction *= factor;
      const auto other = scene.intersect(scaled);
      REQUIRE(hit.has_value() == other.has_value());
      if (!hit) continue;
      int exponent;
      if (std::frexp(factor, &exponent) == 0.5) {
        CHECK(other->t * factor == hit->t);
        CHECK(other->sample.position == hit->sample.position);
      } else {
        CHECK(other->t * factor == Approx(hit->t).epsilon(1e-11));
      }
    }
  }
}

TEST_CASE("Rays that are no rays are errors", "[intersect][scene]") {
  const Scene scene = plane();
  std::vector<Ray> errors{{{0, 0, 1}, {0, 0, 0}}, {{0, 0, 1}, {-0.0, 0, -0.0}}};
  for (const double bad : {not_a_number, infinity, -infinity})
    for (int axis = 0; axis < 3; ++axis) {
      Ray origin = down(), direction = down();
      origin.origin[axis] = bad;
      direction.direction[axis] = bad;
      errors.push_back(origin);
      errors.push_back(direction);
    }
  errors.push_back(down(not_a_number, 1));
  errors.push_back(down(0, not_a_number));
  for (const Ray& ray : errors) {
    CAPTURE(ray.origin.transpose(), ray.direction.transpose(), ray.tmin, ray.tmax);
    CHECK_THROWS_AS(scene.intersect(ray), InputError);
    CHECK_THROWS_AS(scene.occluded(ray), InputError);
  }
  CHECK(scene.statistics().rays == 0);
}

TEST_CASE("A direction may be as short or as long as doubles are", "[intersect][scene]") {
  const Scene scene = plane();
  Ray ray = down();
  ray.direction = {0, 0, -std::numeric_limits<double>::max()};
  CHECK(scene.intersect(ray));
  ray.direction = {0, 0, -1.2e-308};
  CHECK(scene.intersect(ray));
}

TEST_CASE("A direction longer than doubles can say still hits", "[intersect][scene]") {
  const Scene scene(sheet("catmark", 4, 4), "catmark");  // the plane z = 0 over [0, 4]^2
  const Vec3 direction = Vec3(0.3, 0.2, -1) * std::numeric_limits<double>::max();
  CHECK(scene.intersect({{1.3, 2.6, 2}, direction, 0, std::numeric_limits<double>::infinity()}));
}

}  // namespace shaolin
