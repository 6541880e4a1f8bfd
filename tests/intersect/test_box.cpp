// The slab test against a slow one.
#include "intersect/box.h"

#include "tests/catch.h"
#include "tests/intersect/slow_slab.h"

namespace shaolin {

namespace {

struct Tally {
  int met = 0, undecided = 0, lost = 0, invented = 0, wrong_distance = 0;

  void ask(const Box& box, const TraversalRay& ray, double far) {
    const std::optional<double> entry = entry_distance(box, ray, far);
    const Meets expected = slowly_meets(box, ray, far);
    met += expected == Meets::yes;
    undecided += expected == Meets::maybe;
    lost += expected == Meets::yes && !entry;
    invented += expected == Meets::no && entry;
    wrong_distance += entry && !enters_at(box, ray, *entry);
  }

  /// The box is met from that distance on, and not met before it.
  static bool enters_at(const Box& box, const TraversalRay& ray, double distance) {
    if (!std::isfinite(distance)) return distance < 0;  // no slab bounds the ray's start
    TraversalRay line = ray;
    line.near = -std::numeric_limits<double>::infinity();
    const double step = 1e-14 * std::abs(distance) + std::numeric_limits<double>::denorm_min();
    return slowly_meets(box, line, distance + step) != Meets::no &&
           slowly_meets(box, line, distance - step) != Meets::yes;
  }

  void check() const {
    CAPTURE(met, undecided, lost, invented, wrong_distance);
    CHECK(lost == 0);
    CHECK(invented == 0);
    CHECK(wrong_distance == 0);
  }
};

Box between(const Vec3& a, const Vec3& b) {
  Box box;
  box.add(a);
  box.add(b);
  return box;
}

bool is_met(const Box& box, const Ray& ray) { return entry_distance(box, TraversalRay(ray), ray.tmax).has_value(); }

}  // namespace

TEST_CASE("A box is met where a slow test says so", "[intersect][box]") {
  Random random(1);
  Tally tally;
  for (int i = 0; i < 400'000; ++i) {
    const TraversalRay ray(round_ray(random));
    tally.ask(round_box(random), ray, std::min(ray.far, random.uniform(0, 8)));
  }
  tally.check();
  CHECK(tally.met > 20'000);
  CHECK(tally.undecided < 400);
}

TEST_CASE("Boxes of any size are met where a slow test says so", "[intersect][box]") {
  Random random(2);
  Tally tally;
  for (int i = 0; i < 200'000; ++i) {
    // Sizes over 200 binary orders, with the origin at a distance of their own order.
    const double size = std::exp2(random.uniform(-100, 100));
    const double distance = size * random.uniform(0, 4);
    const TraversalRay ray(Ray{distance * random.point(), random.direction()});
    const Vec3 corner = size * random.point();
    tally.ask(between(corner, size * random.point()), ray, ray.far);
  }
  tally.check();
  CHECK(tally.met > 5'000);
}

TEST_CASE("A zero of the direction keeps the ray between its slabs, whatever the zero's sign", "[intersect][box]") {
  const Box box = between({-1, -2, -3}, {1, 2, 3});
  for (const double zero : {0.0, -0.0}) {
    CAPTURE(std::signbit(zero));
    CHECK(is_met(box, {{-5, 0, 0}, {1, zero, zero}}));
    CHECK(is_met(box, {{-5, 2, 0}, {1, zero, zero}}));   // along a face
    CHECK(is_met(box, {{-5, 2, -3}, {1, zero, zero}}));  // along an edge
    CHECK(!is_met(box, {{-5, std::nextafter(2.0, 3.0), 0}, {1, zero, zero}}));
    CHECK(!is_met(box, {{-5, 0, std::nextafter(-3.0, -4.0)}, {1, zero, zero}}));
    CHECK(is_met(box, {{0, 2, 9}, {zero, zero, -1}}));
    CHECK(!is_met(box, {{0, 2, 9}, {zero, zero, 1}}));
  }
}

TEST_CASE("An empty box is met by no ray", "[intersect][box]") {
  Random random(3);
  int met = 0;
  for (int i = 0; i < 10'000; ++i) {
    const TraversalRay ray(round_ray(random));
    met += entry_distance(Box(), ray, ray.far).has_value();
  }
  CHECK(met == 0);
}

TEST_CASE("A ray's interval is closed: boxes that touch its ends are met", "[intersect][box]") {
  const Box box = between({2, -1, -1}, {3, 1, 1});
  const auto met = [&](double tmin, double tmax) { return is_met(box, {{0, 0, 0}, {1, 0, 0}, tmin, tmax}); };
  CHECK(met(0, 2));
  CHECK(met(3, 9));
  CHECK(met(2.5, 2.5));
  CHECK(!met(0, 2 - 1e-14));
  CHECK(!met(3 + 1e-14, 9));
  CHECK(!met(-9, -1));
}

TEST_CASE("A power of two below a number is the one of its exponent", "[intersect][box]") {
  using Limits = std::numeric_limits<double>;
  for (const double x : {1.0, 1.5, std::nextafter(2.0, 0.0), 2.0, 1e300, 1e-300, Limits::max(), Limits::min(), 3e-310,
                         Limits::denorm_min()}) {
    CAPTURE(x);
    CHECK(power_of_two_below(x) == std::scalbn(1.0, std::ilogb(x)));
  }
}

TEST_CASE("The length of a direction scales distances and nothing else", "[intersect][box]") {
  for (const double length : {0x1p-1060, 1e-200, 0.5, 3.0, 1e200}) {
    CAPTURE(length);
    const TraversalRay ray(Ray{Vec3::Zero(), length * Vec3(0, 0.6, -0.8), 0.25, 4});
    // Below the least normal number a product keeps few digits.
    const double tolerance = length < 1e-300 ? 1e-3 : 1e-15;
    CHECK(std::abs(ray.direction.norm() - 1) <= 4 * unit_roundoff);
    CHECK((ray.direction - Vec3(0, 0.6, -0.8)).norm() <= tolerance);
    CHECK(std::abs(ray.length() / length - 1) <= tolerance);
    CHECK(std::abs(ray.near / (0.25 * length) - 1) <= tolerance);
    CHECK(std::abs(ray.far / (4 * length) - 1) <= tolerance);
    CHECK(ray.t(ray.far) == 4);
  }
}

}  // namespace shaolin
