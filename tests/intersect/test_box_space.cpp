// Boxes in single precision: none that a ray meets is left out, wherever the scene is and whatever its size.
#include "intersect/box_space.h"

#include <optional>

#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/slow_slab.h"

namespace shaolin {

namespace {

/// How much farther than a ray a box may be and still be met: some roundings of single precision, of the scene's extent
/// and of how far the ray's start is from its middle.
constexpr double resolution = 0x1p-20;

struct EightBoxesTally {
  int met = 0, lost = 0, invented = 0, out_of_order = 0, late = 0, differ = 0;

  void ask(const std::array<Box, 8>& boxes, const Box& scene, const Ray& given) {
    const TraversalRay ray(given);
    const BoxSpace space(scene);
    const std::optional<double> entry = entry_distance(scene, ray, ray.far);
    if (!entry || ray.near > ray.far) return;
    const double start = std::max(*entry, ray.near);
    const BoxRay box_ray(ray, space, start);
    const float far = box_ray.local(ray.far);
    EightBoxes eight;
    for (std::size_t i = 0; i < 8; ++i) eight.set(i, {boxes[i], space});
    const BoxOrder order(eight, box_ray, far);
    std::array<bool, 8> found{};
    for (std::size_t i = 0; i < order.count(); ++i) {
      const std::size_t box = order.box(i);
      found[box] = true;
      out_of_order += i > 0 && order.distance(i - 1) > order.distance(i);
      // Not met before the distance at which it is said to be entered.
      const double before = (static_cast<double>(order.distance(i)) - 1e-5) / space.scale;
      late += before > 0 && slowly_meets(boxes[box], ray, start + before) == Meets::yes;
    }
    const double extent = (scene.upper - scene.lower).maxCoeff();
    for (std::size_t i = 0; i < 8; ++i) {
      const bool is_met = slowly_meets(boxes[i], ray, ray.far) == Meets::yes;
      const Vec3 margin = Vec3::Constant(resolution * extent);
      TraversalRay longer = ray;
      longer.near -= margin.x();
      met += is_met;
      lost += is_met && !found[i];
      invented += found[i] && slowly_meets({boxes[i].lower - margin, boxes[i].upper + margin}, longer,
                                           ray.far + margin.x()) == Meets::no;
      differ += found[i] != box_ray.meets({boxes[i], space}, far);
    }
  }

  void check() const {
    CAPTURE(met, lost, invented, out_of_order, late, differ);
    CHECK(lost == 0);
    CHECK(invented == 0);
    CHECK(out_of_order == 0);
    CHECK(late == 0);
    CHECK(differ == 0);
    CHECK(met > 20'000);
  }
};

std::array<Box, 8> round_boxes(Random& random) {
  std::array<Box, 8> boxes;
  for (Box& box : boxes) box = round_box(random);
  return boxes;
}

Box bounds_of(const std::array<Box, 8>& boxes) {
  Box scene;
  for (const Box& box : boxes) scene.add(box);
  return scene;
}

}  // namespace

TEST_CASE("Eight boxes are met where each one is, front to back", "[intersect][box]") {
  Random random(1);
  EightBoxesTally tally;
  for (int i = 0; i < 60'000; ++i) {
    const std::array<Box, 8> boxes = round_boxes(random);
    tally.ask(boxes, bounds_of(boxes), round_ray(random));
  }
  tally.check();
}

TEST_CASE("A scene's place, size and distance lose no box", "[intersect][box]") {
  Random random(2);
  EightBoxesTally tally;
  for (int i = 0; i < 60'000; ++i) {
    const double size = std::exp2(random.uniform(-100, 100));
    const double away = size * std::exp2(random.uniform(0, 30));
    const Vec3 place = away * random.point();
    std::array<Box, 8> boxes = round_boxes(random);
    for (Box& box : boxes) box = {place + size * box.lower, place + size * box.upper};
    // Aimed at a box's corner or middle, from as far as a million scenes away.
    const Box& aim = boxes[static_cast<std::size_t>(random.index(8))];
    const Vec3 target = random.index(2) == 0 ? aim.centre() : aim.upper;
    Ray ray{target, random.direction()};
    ray.origin -= size * std::exp2(random.uniform(0, 20)) * ray.direction;
    tally.ask(boxes, bounds_of(boxes), ray);
  }
  tally.check();
}

TEST_CASE("Boxes far outside the scene's bounds, and boxes without bounds, are met", "[intersect][box]") {
  Random random(3);
  Box scene;
  scene.add(Vec3(-1, -1, -1));
  scene.add(Vec3(1, 1, 1));
  const BoxSpace space(scene);
  int met = 0, lost = 0;
  for (int i = 0; i < 20'000; ++i) {
    Box box = round_box(random);
    const double size = std::exp2(random.uniform(0, 60));
    box = {size * box.lower - Vec3::Ones(), size * box.upper + Vec3::Ones()};
    if (i % 10 == 0) box.upper.setConstant(std::numeric_limits<double>::infinity());
    if (i % 20 == 0) box.lower.setConstant(-std::numeric_limits<double>::infinity());
    const TraversalRay ray(round_ray(random));
    const std::optional<double> entry = entry_distance(scene, ray, ray.far);
    if (!entry) continue;
    const BoxRay box_ray(ray, space, std::max(*entry, ray.near));
    TraversalRay inside = ray;
    inside.near = std::max(*entry, ray.near);
    if (inside.near > ray.far) continue;
    if (slowly_meets(box, inside, ray.far) != Meets::yes) continue;
    ++met;
    lost += !box_ray.meets({box, space}, box_ray.local(ray.far));
  }
  CHECK(met > 1'000);
  CHECK(lost == 0);
}

TEST_CASE("A line without a start meets boxes on both sides of its origin", "[intersect][box]") {
  Box scene;
  scene.add(Vec3(-1, -1, -1));
  scene.add(Vec3(1, 1, 1));
  const BoxSpace space(scene);
  const BoxRay line(TraversalRay({{0, 0, 0}, {1, 0.25, 0}, -infinity, infinity}), space, 0);
  const auto meets = [&](const Vec3& middle) {
    const Vec3 half = Vec3::Constant(0.1);
    return line.meets({{middle - half, middle + half}, space}, line.local(infinity));
  };
  CHECK(meets({0.8, 0.2, 0}));
  CHECK(meets({-0.8, -0.2, 0}));
  CHECK(!meets({0.8, -0.2, 0}));
}

TEST_CASE("Empty places of eight are met by no ray", "[intersect][box]") {
  Random random(4);
  std::size_t met = 0;
  Box scene;
  scene.add(Vec3(-2, -2, -2));
  scene.add(Vec3(2, 2, 2));
  for (int i = 0; i < 10'000; ++i) {
    const BoxRay ray(TraversalRay(round_ray(random)), BoxSpace(scene), 0);
    met += BoxOrder(EightBoxes(), ray, std::numeric_limits<float>::infinity()).count();
  }
  CHECK(met == 0);
}

}  // namespace shaolin
