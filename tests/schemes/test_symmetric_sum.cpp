// Sums around a vertex must not show, in any bit, where the walk began or which way it went.
#include "schemes/symmetric_sum.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

namespace {

/// Points whose sums round: magnitudes from 2^-20 to 2^20.
std::vector<Vec3> rounding_points(int n, Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) points.push_back(std::ldexp(1.0, random.index(41) - 20) * random.point());
  return points;
}

Vec3 sum_in(const std::vector<Vec3>& points, const std::vector<int>& order) {
  return symmetric_sum({points.data(), order.data(), static_cast<int>(order.size())});
}

}  // namespace

TEST_CASE("The sum around a ring is the same to the bit from every start, both ways", "[schemes][symmetric_sum]") {
  Random random(5);
  for (int n = 1; n <= 40; ++n)
    for (int round = 0; round < 20; ++round) {
      const std::vector<Vec3> points = rounding_points(n, random);
      std::vector<int> order(static_cast<std::size_t>(n));
      std::iota(order.begin(), order.end(), 0);
      const Vec3 sum = sum_in(points, order);
      CAPTURE(n, round);
      for (int start = 0; start < n; ++start) {
        std::rotate(order.begin(), order.begin() + 1, order.end());
        REQUIRE(sum_in(points, order) == sum);
        std::vector<int> reversed(order.rbegin(), order.rend());
        REQUIRE(sum_in(points, reversed) == sum);
      }
    }
}

TEST_CASE("The sum around a ring is the sum", "[schemes][symmetric_sum]") {
  Random random(6);
  for (int n = 1; n <= 40; ++n) {
    const std::vector<Vec3> points = rounding_points(n, random);
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    double magnitude = 0;
    Eigen::Matrix<long double, 3, 1> exact = Eigen::Matrix<long double, 3, 1>::Zero();
    for (const Vec3& p : points) {
      exact += p.cast<long double>();
      magnitude += p.cwiseAbs().maxCoeff();
    }
    CAPTURE(n);
    CHECK((sum_in(points, order) - exact.cast<double>()).norm() <= n * 0x1p-52 * magnitude);
  }
}

}  // namespace shaolin
