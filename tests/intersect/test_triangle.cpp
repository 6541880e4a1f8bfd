// Ray and triangle: the plane's equation says where they meet, and no ray slips through between two triangles.
#include "intersect/triangle.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/random.h"

namespace shaolin {

namespace {

TraversalRay towards(const Vec3& origin, const Vec3& target) { return TraversalRay(Ray{origin, target - origin}); }

}  // namespace

TEST_CASE("A triangle is met where Cramer's rule says", "[intersect][triangle]") {
  Random random(41);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.point(), b = random.point(), c = random.point(), origin = 3 * random.point();
    const TraversalRay ray = towards(origin, random.point());
    Eigen::Matrix3d system;
    system << b - a, c - a, -ray.direction;
    const Vec3 solution = system.inverse() * (origin - a);
    const double inside = std::min({solution.x(), solution.y(), 1 - solution.x() - solution.y(), solution.z()});
    if (std::abs(inside) < 1e-9 || std::abs(system.determinant()) < 1e-3) continue;
    const auto meeting = TriangleRay(ray).meet(a, b, c, 0, infinity);
    REQUIRE(meeting.has_value() == (inside > 0));
    REQUIRE(TriangleRay(ray).meet(c, b, a, 0, infinity).has_value() == (inside > 0));  // from behind as well
    if (!meeting) continue;
    ++met;
    CHECK(std::abs(meeting->distance - solution.z()) < 1e-11);
    CHECK(std::abs(meeting->weights[1] - solution.x()) < 1e-11);
    CHECK(std::abs(meeting->weights[2] - solution.y()) < 1e-11);
    CHECK(!TriangleRay(ray).meet(a, b, c, 0, 0.999 * meeting->distance));
    CHECK(!TriangleRay(ray).meet(a, b, c, 1.001 * meeting->distance, infinity));
  }
  CHECK(met > 100);
}

TEST_CASE("Rays at corners and sides of a fan meet one of its triangles", "[intersect][triangle]") {
  Random random(42);
  for (int i = 0; i < 300; ++i) {
    // A closed fan of 4 to 9 triangles around its apex, seen from above; no angle of a triangle there reaches 180
    // degrees.
    const int n = 4 + random.index(6);
    const Vec3 apex = random.point(), origin = apex + Vec3(0, 0, 5);
    std::vector<Vec3> rim;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * 3.141592653589793 * (k + 0.8 * random.uniform()) / n;
      const double height = random.uniform(-0.2, 0.2);
      rim.emplace_back(apex + Vec3(std::cos(angle), std::sin(angle), height));
    }
    std::vector<Vec3> targets{apex};
    for (const Vec3& end : rim)
      for (const double along : {1e-9, 0.25, 0.5, random.uniform()}) targets.push_back(apex + along * (end - apex));
    for (const Vec3& target : targets) {
      const TriangleRay ray(towards(origin, target));
      int met = 0;
      for (int k = 0; k < n; ++k)
        met += ray.meet(apex, rim[static_cast<std::size_t>(k)], rim[static_cast<std::size_t>((k + 1) % n)], 0, infinity)
                   .has_value();
      CHECK(met >= 1);
    }
  }
}

TEST_CASE("A triangle seen edge-on, or of no area, is missed", "[intersect][triangle]") {
  const TriangleRay ray(TraversalRay(Ray{{-5, 0, 0}, {1, 0, 0}}));
  CHECK(!ray.meet({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0, infinity));
  CHECK(!ray.meet({0, 0, 0}, {0, 0, 0}, {0, 0, 1}, 0, infinity));
  CHECK(!ray.meet({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, infinity));
}

}  // namespace shaolin
