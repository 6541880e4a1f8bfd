// The hierarchy leaves out no box that a ray meets, and visits few that it misses: against a slow test of every box, in
// extended precision.
#include "intersect/bvh.h"

#include <set>

#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/slow_slab.h"
#include "tests/random.h"

namespace shaolin {

namespace {

/// True if a point of the closed box, grown by `margin`, lies on the line within [near, far]. By clipping the interval
/// axis by axis, in long double: no infinities of zero directions to juggle with.
bool meets(const Box& box, const TraversalRay& ray, double far, long double margin) {
  long double from = ray.near, to = far;
  from -= margin;
  to += margin;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const long double lower = static_cast<long double>(box.lower[axis]) - margin - ray.origin[axis];
    const long double upper = static_cast<long double>(box.upper[axis]) + margin - ray.origin[axis];
    const long double d = ray.direction[axis];
    if (d == 0) {
      if (lower > 0 || upper < 0) return false;
      continue;
    }
    from = std::max(from, std::min(lower / d, upper / d));
    to = std::min(to, std::max(lower / d, upper / d));
  }
  return from <= to;
}

/// Which primitives are visited, each at most once.
std::set<int> visited(const Bvh& bvh, const TraversalRay& ray, double far) {
  std::set<int> result;
  const std::optional<BoxRay> box_ray = bvh.enter(ray);
  if (!box_ray) return result;
  bvh.traverse(
      *box_ray, [&, local = box_ray->local(far)] { return local; },
      [&](int primitive) {
        CHECK(result.insert(primitive).second);
        return false;
      });
  return result;
}

/// Every box that the ray meets is visited, and none that it misses by more than rounding. Returns how many are met.
int check_ray(const std::vector<Box>& boxes, const Bvh& bvh, const Ray& given) {
  const TraversalRay ray(given);
  const std::set<int> found = visited(bvh, ray, ray.far);
  // Some roundings of single precision, of the scene's extent.
  const double size = boxes.empty() ? 0 : (bvh.bounds().upper - bvh.bounds().lower).maxCoeff();
  int met = 0, lost = 0, surplus = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const bool is_found = found.contains(static_cast<int>(i)), is_met = meets(boxes[i], ray, ray.far, 0);
    met += is_met;
    lost += is_met && !is_found;
    surplus += is_found && !meets(boxes[i], ray, ray.far, 1e-6L * size);
  }
  CAPTURE(boxes.size(), given.origin.transpose(), given.direction.transpose(), given.tmin, given.tmax);
  CHECK(lost == 0);
  CHECK(surplus == 0);
  return met;
}

Box box_of(const Vec3& a, const Vec3& b) {
  Box box;
  box.add(a);
  box.add(b);
  return box;
}

/// A point of [-2, 2]^3 on a grid of eighths, so that rays along faces and through corners are exact.
Vec3 grid_point(Random& random) {
  Vec3 point;
  for (Eigen::Index axis = 0; axis < 3; ++axis) point[axis] = (random.index(33) - 16) / 8.0;
  return point;
}

/// Boxes with corners on the grid; many are flat, a line or a point.
std::vector<Box> grid_boxes(int count, Random& random) {
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3 a = grid_point(random);
    Vec3 size = grid_point(random).cwiseAbs();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      if (random.index(4) == 0) size[axis] = 0;
    boxes.push_back(box_of(a, a + size));
  }
  return boxes;
}

/// Rays that slabs get wrong first: along axes and diagonals, with 0 and -0, from and through the grid's points.
Ray grid_ray(Random& random) {
  Vec3 direction;
  do {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const int kind = random.index(5);
      direction[axis] = kind == 0 ? 0.0 : kind == 1 ? -0.0 : kind == 2 ? 1 : kind == 3 ? -1 : random.uniform(-1, 1);
    }
  } while (direction.isZero(0));
  const Vec3 target = grid_point(random);
  const double back = random.index(3) * 2;
  return {target - back * direction, direction, 0, infinity};
}

}  // namespace

TEST_CASE("Traversal visits what the ray meets, whatever the number of boxes", "[intersect][bvh]") {
  Random random(61);
  int met = 0;
  for (const int count : {0, 1, 2, 3, 4, 5, 16, 17, 100, 1000}) {
    const std::vector<Box> boxes = grid_boxes(count, random);
    const Bvh bvh(boxes);
    for (int i = 0; i < 300; ++i) met += check_ray(boxes, bvh, grid_ray(random));
  }
  CHECK(met > 3000);
}

TEST_CASE("Traversal keeps to the interval, its ends included", "[intersect][bvh]") {
  Random random(62);
  const std::vector<Box> boxes = grid_boxes(200, random);
  const Bvh bvh(boxes);
  for (int i = 0; i < 500; ++i) {
    Ray ray = grid_ray(random);
    // Where the direction is an axis, ends in eighths lie exactly on faces.
    ray.tmin = (random.index(33) - 8) / 8.0;
    ray.tmax = ray.tmin + random.index(9) / 8.0;
    check_ray(boxes, bvh, ray);
  }
  const std::vector<Box> one{box_of({1, 1, 1}, {2, 2, 2})};
  const auto count = [&](double tmin, double tmax) {
    return visited(Bvh(one), TraversalRay({{1.5, 1.5, 0}, {0, 0, 1}, tmin, tmax}), tmax).size();
  };
  CHECK(count(0, 1) == 1);
  CHECK(count(2, 3) == 1);
  CHECK(count(0, 0.999) == 0);
  CHECK(count(2.001, 3) == 0);
}

TEST_CASE("Coincident boxes are all visited", "[intersect][bvh]") {
  for (const int count : {2, 7, 64, 500}) {
    const std::vector<Box> same(static_cast<std::size_t>(count), box_of({-1, -1, -1}, {1, 1, 1}));
    CHECK(check_ray(same, Bvh(same), {{0.25, 0.5, -3}, {0, 0, 1}}) == count);
    const std::vector<Box> points(static_cast<std::size_t>(count), box_of({1, 2, 3}, {1, 2, 3}));
    CHECK(check_ray(points, Bvh(points), {{1, 2, 0}, {0, 0, 1}}) == count);
    CHECK(check_ray(points, Bvh(points), {{1, 2, 0}, {0, 0, -1}}) == 0);
  }
}

TEST_CASE("Tiny boxes are found beside huge ones", "[intersect][bvh]") {
  Random random(63);
  for (const double huge : {1e6, 1e100, 1e200}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 40; ++i) {
      const Vec3 a = random.point(), size = 1e-6 * random.point().cwiseAbs();
      boxes.push_back(box_of(a, a + size));
      const Vec3 far = huge * random.point();
      boxes.push_back(box_of(far, -random.uniform() * far));
    }
    const Bvh bvh(boxes);
    for (std::size_t i = 0; i < boxes.size(); i += 2) {
      const Vec3 direction = random.direction();
      const TraversalRay ray({boxes[i].centre() - direction, direction});
      const std::set<int> found = visited(bvh, ray, infinity);
      for (std::size_t k = 0; k < boxes.size(); ++k)
        if (meets(boxes[k], ray, infinity, 0)) CHECK(found.contains(static_cast<int>(k)));
    }
  }
}

TEST_CASE("A skewed hierarchy is traversed to its end", "[intersect][bvh]") {
  // Each box half as far as the last: every split takes one off, so the depth grows with the number of boxes.
  std::vector<Box> boxes;
  for (int i = 0; i < 900; ++i) boxes.push_back(box_of({0, 0, 0}, {std::ldexp(1, -i), 1, 1}));
  const Bvh bvh(boxes);
  CHECK(check_ray(boxes, bvh, {{0, 0.5, -1}, {0, 0, 1}}) == 900);
  CHECK(check_ray(boxes, bvh, {{0x1p-15, 0.5, -1}, {0, 0, 1}}) == 16);
}

TEST_CASE("What is said to pass the bounds by misses them, and most that misses them is said to", "[intersect][bvh]") {
  Random random(8);
  int met = 0, lost = 0, missed = 0, said = 0;
  for (int i = 0; i < 50'000; ++i) {
    const double size = std::exp2(random.uniform(-40, 40)), length = std::exp2(random.uniform(-300, 300));
    const Vec3 shift = i % 2 == 0 ? Vec3(Vec3::Zero()) : Vec3(size * std::exp2(random.uniform(0, 30)) * random.point());
    const Box round = round_box(random), box{size * round.lower + shift, size * round.upper + shift};
    Ray line = round_ray(random);
    line = {size * line.origin + shift, length * line.direction, -infinity, infinity};
    const bool is_passed_by = Bvh({box}).is_passed_by(line);
    const bool is_met = slowly_meets(box, TraversalRay(line), infinity) != Meets::no;
    met += is_met;
    lost += is_met && is_passed_by;
    missed += !is_met;
    said += is_passed_by;
  }
  CHECK(met > 5'000);
  CHECK(missed > 10'000);
  CHECK(lost == 0);
  CHECK(said > 0.95 * missed);
}

TEST_CASE("Traversal stops when told, and leaves out what a shrinking far excludes", "[intersect][bvh]") {
  std::vector<Box> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back(box_of({0, 0, 2.0 * i}, {1, 1, 2.0 * i + 1}));
  const Bvh bvh(boxes);
  const std::optional<BoxRay> ray = bvh.enter(TraversalRay({{0.5, 0.5, -1}, {0, 0, 1}}));
  REQUIRE(ray);
  int visits = 0, least = 100;
  float far = ray->local(infinity);
  bvh.traverse(
      *ray, [&] { return far; },
      [&](int primitive) {
        ++visits;
        least = std::min(least, primitive);
        far = std::min(far, ray->local(2 * primitive + 1.5));
        return false;
      });
  CHECK(least == 0);
  CHECK(visits == 1);  // disjoint boxes in a row: the nearest comes first
  visits = 0;
  bvh.traverse(
      *ray, [&] { return ray->local(infinity); },
      [&](int) {
        ++visits;
        return visits == 3;
      });
  CHECK(visits == 3);
}

TEST_CASE("An empty box, or one without end, hides no other", "[intersect][bvh]") {
  for (const bool is_empty : {true, false}) {
    std::vector<Box> boxes;
    for (int i = 0; i < 50; ++i) boxes.push_back({Vec3(i, 0, 0), Vec3(i + 0.5, 1, 1)});
    boxes[7] = is_empty ? Box() : Box{Vec3::Constant(-infinity), Vec3::Constant(infinity)};
    const Bvh bvh(boxes);
    for (int i = 0; i < 50; ++i) {
      CAPTURE(is_empty, i);
      const std::set<int> met = visited(bvh, TraversalRay({{i + 0.25, 0.5, 5}, {0, 0, -1}, 0, 100}), 100);
      CHECK((met.count(i) == 1) == !(is_empty && i == 7));
    }
  }
  CHECK(visited(Bvh({Box(), Box()}), TraversalRay({{0, 0, 5}, {0, 0, -1}, 0, 100}), 100).empty());
}

}  // namespace shaolin
