// Bounds of distances from boxes: never too large, and tight where they can be.
#include "intersect/box_point.h"
#include "tests/catch.h"
#include "tests/random.h"

namespace shaolin {

TEST_CASE("A box is never nearer than its bound says", "[intersect][closest]") {
  using Exact = Eigen::Matrix<long double, 3, 1>;
  Random random(31);
  int nearer = 0, lost = 0, differ = 0;
  double loosest = 0;
  for (int round = 0; round < 400; ++round) {
    const BoxSpace space(Box{Vec3::Constant(-1), Vec3::Constant(1)});
    Eigen::Matrix3d metric = Eigen::Matrix3d::Identity();
    const bool uneven = round % 2 == 1;
    if (uneven) metric << 2, 0.7, -1, 0, 0.3, 0.4, 0, 0, 5;
    const Vec3 point = std::exp2(random.uniform(-2, round % 3 ? 3 : 40)) * random.direction();
    const BoxPoint asked(point, metric, 0, Box{Vec3::Constant(-1), Vec3::Constant(1)});
    EightBoxes boxes;
    std::array<SceneBox, 8> singles;
    const std::size_t count = 1 + static_cast<std::size_t>(random.index(8));
    for (std::size_t i = 0; i < count; ++i) {
      Box box;
      for (int k = 0; k < 2; ++k) box.add(0.7 * random.point());
      singles[i] = SceneBox(box, space);
      boxes.set(i, singles[i]);
    }
    std::array<float, 8> entries;
    const unsigned met = asked.meet(boxes, std::numeric_limits<float>::infinity(), entries);
    lost += met != (1U << count) - 1;
    for (std::size_t i = 0; i < count; ++i) {
      differ += asked.distance(singles[i]) != entries[i];
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 200; ++k) {
        Vec3 y;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const auto a = static_cast<std::size_t>(axis);
          const double low = singles[i].bounds[0][a], high = singles[i].bounds[1][a];
          // The nearest of the box where the metric is even, any elsewhere.
          y[axis] = k == 0 ? std::clamp(point[axis], low, high) : random.uniform(low, high);
        }
        const Exact way = metric.cast<long double>() * (y - point).cast<long double>();
        const double distance = static_cast<double>(way.norm());
        least = std::min(least, distance);
        nearer += asked.local(distance) < entries[i];
      }
      const bool is_met = asked.meet(boxes, asked.local(least), entries) >> i & 1;
      lost += !is_met;
      if (!uneven) loosest = std::max(loosest, asked.local(least) - static_cast<double>(entries[i]));
    }
  }
  CHECK(nearer == 0);
  CHECK(lost == 0);
  CHECK(differ == 0);
  CHECK(loosest < 0.05);  // of doubles of some 2^40
}

}  // namespace shaolin
