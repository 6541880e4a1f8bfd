// A plane between hulls of points is found where there is one, and is none where they have a point in common.
#include "intersect/separation.h"

#include <algorithm>

#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

namespace {

using Points = std::vector<Vec3>;

Vec3 lowest_of(const Points& points, const Vec3& n) {
  return *std::min_element(points.begin(), points.end(),
                           [&](const Vec3& a, const Vec3& b) { return n.dot(a) < n.dot(b); });
}

bool separable(const Points& a, const Points& b, const Vec3& guess) {
  return are_separable([&](const Vec3& n) -> Vec3 { return lowest_of(a, n) - lowest_of(b, -n); }, guess, 1e-14);
}

/// Points of a random hull, as thin as 1e-5 across its longest way.
Points random_hull(Random& random) {
  Eigen::Matrix3d shape;
  for (Eigen::Index i = 0; i < 3; ++i) shape.col(i) = std::pow(10, random.uniform(-5, 0)) * random.direction();
  Points points(16);
  for (Vec3& point : points) point = shape * random.point();
  return points;
}

Points moved(Points points, const Vec3& way) {
  for (Vec3& point : points) point += way;
  return points;
}

}  // namespace

TEST_CASE("Hulls on two sides of a plane are separable, hulls with a point in common are not",
          "[intersect][separation]") {
  Random random(61);
  int found = 0;
  constexpr int rounds = 20000;
  for (int round = 0; round < rounds; ++round) {
    const Points a = random_hull(random), b = random_hull(random);
    const Vec3 n = random.direction(), guess = random.direction();
    // Side by side on the plane, with a gap above the margin.
    const double gap = std::pow(10, random.uniform(-9, 0));
    const Points beside = moved(b, (lowest_of(a, n) - lowest_of(b, -n)) - gap * n);
    found += separable(a, beside, guess);
    // A mean of points of the one on a mean of points of the other.
    const double s = random.uniform(0, 1), t = random.uniform(0, 1);
    const Points across = moved(b, (s * a[0] + (1 - s) * a[1]) - (t * b[0] + (1 - t) * b[1]));
    REQUIRE(!separable(a, across, guess));
  }
  // Of needles side by side some take more steps than there are.
  CHECK(found > 0.99 * rounds);
}

TEST_CASE("Edges that cross at a small distance are separable", "[intersect][separation]") {
  Random random(62);
  for (int round = 0; round < 2000; ++round) {
    const Vec3 a = random.direction(), b = random.direction(), n = a.cross(b).normalized();
    const double gap = std::pow(10, random.uniform(-10, -1));
    // Wedges away from each other, with the two directions for edges.
    const Points above{-a, a, random.uniform(-1, 1) * a + n + b, random.uniform(-1, 1) * a + n - b};
    const Points below{-b - gap * n, b - gap * n, random.uniform(-1, 1) * b - (1 + gap) * n + a,
                       random.uniform(-1, 1) * b - (1 + gap) * n - a};
    CAPTURE(round, gap);
    CHECK(separable(above, below, random.direction()));
  }
}

}  // namespace shaolin
