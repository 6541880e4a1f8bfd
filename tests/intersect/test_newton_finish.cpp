// Newton finish on patches made by hand, in a ray's frame: x and y vanish on the ray, z is the distance along it.
#include "intersect/newton_finish.h"

#include <functional>
#include <optional>

#include "schemes/bezier_quad.h"
#include "schemes/bezier_triangle.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/hand_made_patches.h"
#include "tests/random.h"

namespace shaolin {

namespace {

struct Interval {
  double near = 0, far = infinity;
  bool far_is_hit = false;
};

template <class Bezier>
std::optional<PatchHit> solve(const Bezier& patch, const Interval& interval = {}) {
  RayCounters counters;
  NewtonFinish<Bezier> finish(patch_error, interval.near, interval.far, interval.far_is_hit, counters);
  if (!finish.solve(Net(patch))) return {};
  return finish.hit();
}

BezierTriangle triangle(const std::function<Vec3(double, double)>& place) {
  BezierTriangle patch;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i + j <= 4; ++i) patch.b[BezierTriangle::index(i, j)] = place(i / 4.0, j / 4.0);
  return patch;
}

/// Adds (c - (2 u - 1)^2) to x, exactly: the Bezier points of (2 u - 1)^2 are 1, -1/3, -1/3, 1 in a cubic.
BezierQuad folded(double c, double slope) {
  constexpr std::array<double, 4> square{1, -1.0 / 3, -1.0 / 3, 1};
  BezierQuad patch = quad([&](double u, double v) { return Vec3(0, v - 0.375, 3 + slope * u); });
  for (std::size_t k = 0; k < 16; ++k) patch.b[k].x() = square[k % 4] - c;
  return patch;
}

template <class Bezier>
Bezier random_patch(Random& random, double wildness) {
  const Vec3 shift = 0.5 * random.point() - Vec3(0.4, 0.4, -4);
  const auto place = [&](double u, double v) -> Vec3 { return Vec3(u, v, 0) + shift + wildness * random.point(); };
  if constexpr (std::is_same_v<Bezier, BezierQuad>)
    return quad(place);
  else
    return triangle(place);
}

/// All zeros that Newton's method reaches from a grid of starts, outside steps allowed: the slow, independent answer.
/// Empty if a zero is too near to the border or to a fold to be sure of it.
template <class Bezier>
std::optional<std::vector<double>> zeros(const Bezier& patch) {
  using D = typename Bezier::DomainType;
  std::vector<double> distances;
  constexpr int grid = 24;
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j) {
      Parameter at(static_cast<double>(i) / grid, static_cast<double>(j) / grid);
      if (!D::contains(at)) continue;
      double determinant = 0;
      for (int step = 0; step < 40; ++step) {
        const Derivatives d = patch.derivatives(at);
        const Vec3 p = patch.position(at);
        determinant = d.du.x() * d.dv.y() - d.du.y() * d.dv.x();
        at -= Parameter(d.dv.y() * p.x() - d.dv.x() * p.y(), d.du.x() * p.y() - d.du.y() * p.x()) / determinant;
        if (!at.allFinite() || at.norm() > 3) break;
      }
      if (!at.allFinite() || at.norm() > 3) continue;
      const Vec3 p = patch.position(at);
      if (p.head<2>().norm() > 1e-12) continue;
      const double outside = (at - D::nearest(at)).norm();
      const double border = D::corner_count == 3 ? std::min({at.x(), at.y(), 1 - at.x() - at.y()})
                                                 : std::min({at.x(), at.y(), 1 - at.x(), 1 - at.y()});
      if (outside > 1e-6) continue;
      if (border < 1e-6 || std::abs(determinant) < 1e-3) return {};
      distances.push_back(p.z());
    }
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace

TEMPLATE_TEST_CASE("The finish meets planes where they are met", "[intersect][finish]", BezierQuad, BezierTriangle) {
  Random random(51);
  for (int i = 0; i < 500; ++i) {
    Parameter at{random.uniform(), random.uniform()};
    const Vec3 du = random.point(), dv = random.point();
    if (std::abs(du.x() * dv.y() - du.y() * dv.x()) < 0.01) continue;
    if (!TestType::DomainType::contains(at)) at = Parameter(1, 1) - at;
    const auto place = [&](double u, double v) -> Vec3 {
      return Vec3(0, 0, 5) + (u - at.x()) * du + (v - at.y()) * dv;
    };
    TestType patch;
    if constexpr (std::is_same_v<TestType, BezierQuad>)
      patch = quad(place);
    else
      patch = triangle(place);
    const auto hit = solve(patch);
    REQUIRE(hit);
    CHECK((hit->at - at).norm() < 1e-11);
    CHECK(std::abs(hit->distance - 5) < 1e-11);
    for (Vec3& p : patch.b) p.x() += 4;  // no point is farther from the middle than sqrt(3) times 2
    CHECK(!solve(patch));
  }
}

TEMPLATE_TEST_CASE("The interval's ends count, a hit elsewhere must be beaten", "[intersect][finish]", BezierQuad,
                   BezierTriangle) {
  const auto place = [](double u, double v) { return Vec3(u - 0.25, v - 0.25, 5); };
  TestType patch;
  if constexpr (std::is_same_v<TestType, BezierQuad>)
    patch = quad(place);
  else
    patch = triangle(place);
  CHECK(solve(patch, {5, 5}));
  CHECK(solve(patch, {0, 5}));
  CHECK(solve(patch, {-infinity, infinity}));
  CHECK(!solve(patch, {5 + 1e-11, infinity}));
  CHECK(!solve(patch, {0, 5 - 1e-11}));
  CHECK(!solve(patch, {0, 5, true}));
  CHECK(solve(patch, {0, 5 + 1e-11, true}));
}

TEST_CASE("A bilinear patch is met where its rulings say", "[intersect][finish]") {
  // x = u - a, y = v - b, z = 3 + u v: the hit is at (a, b), 3 + a b.
  for (const double a : {0.0, 0.125, 0.3, 1.0})
    for (const double b : {0.0, 0.7, 0.75, 1.0}) {
      const auto hit = solve(quad([&](double u, double v) { return Vec3(u - a, v - b, 3 + u * v); }));
      REQUIRE(hit);
      CHECK((hit->at - Parameter(a, b)).norm() < 1e-12);
      CHECK(std::abs(hit->distance - (3 + a * b)) < 1e-12);
    }
  // Two rulings through the ray: x = (u - v), y = u v - 1/4 vanish at (1/2, 1/2) only; x = u + v - 1, y = u v - 3/16 at
  // (1/4, 3/4) and (3/4, 1/4).
  const auto one = solve(quad([](double u, double v) { return Vec3(u - v, u * v - 0.25, 3); }));
  REQUIRE(one);
  CHECK((one->at - Parameter(0.5, 0.5)).norm() < 1e-12);
  const auto two = solve(quad([](double u, double v) { return Vec3(u + v - 1, u * v - 0.1875, 3 - u); }));
  REQUIRE(two);
  CHECK((two->at - Parameter(0.75, 0.25)).norm() < 1e-12);
  CHECK(std::abs(two->distance - 2.25) < 1e-12);
}

TEST_CASE("Of two zeros of a folded patch the nearer counts", "[intersect][finish]") {
  for (const double c : {0.5, 0.25, 1e-2, 1e-4, 1e-8})
    for (const double slope : {1.0, -1.0}) {
      CAPTURE(c, slope);
      const double u = 0.5 * (1 - slope * std::sqrt(c));  // the zeros are (1 -+ sqrt(c)) / 2
      const auto hit = solve(folded(c, slope));
      REQUIRE(hit);
      // Near a fold, an error e of x moves u by e / (4 sqrt(c)).
      const double allowed = 1e-12 + patch_error / std::sqrt(c);
      CHECK(std::abs(hit->at.x() - u) < allowed);
      CHECK(std::abs(hit->at.y() - 0.375) < 1e-12);
      CHECK(std::abs(hit->distance - (3 + slope * u)) < allowed);
      const double farther = 3 + slope * (1 - u), between = 0.5 * (hit->distance + farther);
      const auto second = solve(folded(c, slope), {between, infinity});
      REQUIRE(second);
      CHECK(std::abs(second->distance - farther) < allowed);
      CHECK(!solve(folded(c, slope), {farther + 2 * allowed, infinity}));
    }
}

TEST_CASE("A ray that touches a fold hits, one beside it misses", "[intersect][finish]") {
  const auto touching = solve(folded(0, 1));
  REQUIRE(touching);
  CHECK(std::abs(touching->at.x() - 0.5) < 1e-6);  // the root of the error
  CHECK(std::abs(touching->distance - 3.5) < 1e-6);
  CHECK(solve(folded(-0.5 * patch_error, 1)));  // rounding alone could have moved the fold off the ray
  CHECK(!solve(folded(-10 * patch_error, 1)));
  CHECK(!solve(folded(-1e-6, 1)));
  CHECK(!solve(folded(-0.5, 1)));
}

// Each of its points is met along a curve of parameters, at one distance, which the cells around that curve do not show
// by their own distances alone.
TEMPLATE_TEST_CASE("Where a patch is collapsed to a segment, a ray across it asks few cells", "[intersect][finish]",
                   BezierQuad, BezierTriangle) {
  Random random(12);
  for (int k = 0; k < 200; ++k) {
    TestType patch;
    const Vec3 way = random.point();
    for (Vec3& point : patch.b) point = random.uniform(0, 1) * way;
    const double share = random.uniform(0.3, 0.7);
    const Vec3 met = patch.position(TestType::DomainType::centre() + 0.2 * Parameter(share - 0.5, share - 0.5));
    for (Vec3& point : patch.b) point += Vec3(0, 0, 3) - met;
    RayCounters counters;
    NewtonFinish<TestType> finish(patch_error, 0, infinity, false, counters);
    REQUIRE(finish.solve(Net(patch)));
    CHECK(finish.hit().distance == Approx(3).margin(1e-9));
    CHECK(counters.cells < 4000);
  }
}

// All of such a patch is on the ray, and its nearest point is looked for.
TEMPLATE_TEST_CASE("A ray along a patch collapsed to a segment asks few cells", "[intersect][finish]", BezierQuad,
                   BezierTriangle) {
  using D = typename TestType::DomainType;
  Random random(14);
  for (int k = 0; k < 200; ++k) {
    TestType patch;
    for (Vec3& point : patch.b) point = Vec3(0, 0, random.uniform(3, 4));
    double nearest = infinity, farthest = 0;
    for (int i = 0; i < 2000; ++i) {
      const double z = patch.position(D::nearest({random.uniform(0, 1), random.uniform(0, 1)})).z();
      nearest = std::min(nearest, z);
      farthest = std::max(farthest, z);
    }
    for (const double near : {0.0, 0.5 * (nearest + farthest)}) {
      RayCounters counters;
      NewtonFinish<TestType> finish(patch_error, near, infinity, false, counters);
      REQUIRE(finish.solve(Net(patch)));
      const PatchHit& hit = finish.hit();
      if (near == 0) {
        CHECK(hit.distance <= nearest + 1e-11);
        CHECK(hit.distance == Approx(patch.position(hit.at).z()).margin(1e-12));
      } else {
        CHECK(hit.distance == Approx(near).margin(1e-12));
        CHECK(patch.position(hit.at).z() == Approx(near).margin(1e-11));
      }
      CHECK(counters.cells < 4000);
    }
  }
}

// The points within the error of a ray that grazes the surface are far from each other; the map says more.
TEST_CASE("A grazing ray is met as exactly as the map allows", "[intersect][finish]") {
  Random random(13);
  for (int k = 0; k < 100; ++k) {
    const double slope = std::exp2(random.uniform(-36, -30)), bend = random.uniform(-0.3, 0.3);
    const double at = random.uniform(0.2, 0.8);
    // x = slope (w + bend w^2) for w = u - at; in Bezier form squares are products of neighbours, (i (i - 1)) / 6.
    BezierQuad patch = quad([&](double u, double v) { return Vec3(0, v - 0.375, 3 + u); });
    for (std::size_t j = 0; j < 16; ++j) {
      const double i = static_cast<double>(j % 4), u = i / 3, square = i * (i - 1) / 6;
      patch.b[j].x() = slope * (u - at + bend * (square - 2 * at * u + at * at));
    }
    const auto hit = solve(patch);
    REQUIRE(hit);
    CHECK(std::abs(hit->distance - (3 + at)) <= 1e-15 / slope);
  }
}

TEST_CASE("A hit at a corner stays on the ray where u and v run nearly one way", "[intersect][finish]") {
  // A quarter of a needle of length 1e6, through whose tip a ray goes to within rounding.
  BezierQuad patch;
  patch.b = {Vec3(2.9103830456733704e-10, 0, 5188316.3283173824),
             Vec3(12090.049631186179, 6191.0748772403458, 5163723.6789057991),
             Vec3(21157.612646861002, 10834.393039179267, 5145279.1371404678),
             Vec3(27958.313440759841, 14316.897188623785, 5131445.6827208595),
             Vec3(12090.083645643434, 6191.1497569349594, 5163723.8933993429),
             Vec3(21157.624101516092, 10834.448816901655, 5145279.3577064034),
             Vec3(27958.304635136679, 14316.934848288773, 5131445.9027397744),
             Vec3(33058.842885385035, 16928.814541809494, 5121070.7647464694),
             Vec3(21157.671208489919, 10834.508610878605, 5145279.5698704589),
             Vec3(27958.329754606879, 14316.976079804823, 5131446.1210252689),
             Vec3(33058.848356158764, 16928.838158059516, 5121070.9827552699),
             Vec3(36884.264556050068, 18887.749535695999, 5113289.5836479776),
             Vec3(27958.383635266684, 14317.021200192976, 5131446.32996294),
             Vec3(33058.88073150022, 16928.865182044683, 5121071.1974234134),
             Vec3(36884.277842251235, 18887.759408033453, 5113289.7978746742),
             Vec3(39753.352412705135, 20356.944574010675, 5107453.7041062275)};
  constexpr double error = 1.3e-7;
  RayCounters counters;
  NewtonFinish<BezierQuad> finish(error, 0, infinity, false, counters);
  REQUIRE(finish.solve(Net(patch)));
  const Vec3 position = patch.position(finish.hit().at);
  CHECK(std::max(std::abs(position.x()), std::abs(position.y())) <= 2 * error);
}

TEMPLATE_TEST_CASE("A ray through a corner or a side hits", "[intersect][finish]", BezierQuad, BezierTriangle) {
  Random random(52);
  using D = typename TestType::DomainType;
  for (int i = 0; i < 300; ++i) {
    const auto patch = random_patch<TestType>(random, 0.05);
    for (std::size_t k = 0; k < D::corners.size(); ++k) {
      const auto &a = D::corners[k], &b = D::corners[(k + 1) % D::corners.size()];
      for (const double along : {0.0, 1e-9, 0.5, random.uniform()}) {
        const Parameter at(a[0] + along * (b[0] - a[0]), a[1] + along * (b[1] - a[1]));
        const Vec3 target = patch.position(at);
        TestType moved = patch;
        for (Vec3& p : moved.b) p -= Vec3(target.x(), target.y(), 0);
        const auto hit = solve(moved);
        CAPTURE(i, k, along);
        REQUIRE(hit);
        CHECK(D::contains(hit->at));
        CHECK(std::abs(hit->distance - target.z()) < 1e-11);
      }
    }
  }
}

TEMPLATE_TEST_CASE("Of patches that share a side, one takes the ray through it", "[intersect][finish]", BezierQuad,
                   BezierTriangle) {
  Random random(53);
  for (int i = 0; i < 300; ++i) {
    const auto patch = random_patch<TestType>(random, 0.05);
    // u = 1/2 is a side of two quarters, of a quad's and of a triangle's.
    const double along = random.uniform(0.01, 0.49);
    const Vec3 target = patch.position({0.5, along});
    TestType moved = patch;
    for (Vec3& p : moved.b) p -= Vec3(target.x(), target.y(), 0);
    int met = 0;
    for (const TestType& quarter : moved.split()) {
      const auto hit = solve(quarter);
      met += hit.has_value();
      if (hit) CHECK(std::abs(hit->distance - target.z()) < 1e-11);
    }
    CHECK(met >= 1);
    CHECK(met <= 2);
  }
}

TEMPLATE_TEST_CASE("The finish agrees with Newton's method from everywhere", "[intersect][finish]", BezierQuad,
                   BezierTriangle) {
  Random random(54);
  int undecided = 0, none = 0, several = 0;
  constexpr int count = 600;
  for (int i = 0; i < count; ++i) {
    const auto patch = random_patch<TestType>(random, 1);
    const auto expected = zeros(patch);
    if (!expected) {
      ++undecided;
      continue;
    }
    const auto hit = solve(patch);
    CAPTURE(i);
    REQUIRE(hit.has_value() == !expected->empty());
    none += expected->empty();
    if (expected->empty()) continue;
    CHECK(std::abs(hit->distance - expected->front()) < 1e-9);
    several += expected->back() - expected->front() > 1e-6;
    CHECK(patch.position(hit->at).template head<2>().norm() < 1e-12);
  }
  CHECK(undecided < count / 50);
  CHECK(none > count / 20);
  CHECK(several > count / 30);
}

TEMPLATE_TEST_CASE("A ray that settles for any hit finds one where there is one, by fewer values of the map",
                   "[intersect][finish]", BezierQuad, BezierTriangle) {
  Random random(55);
  int hits = 0, off = 0;
  RayCounters closest, any, closest_of_wild, any_of_wild;
  for (int i = 0; i < 4000; ++i) {
    // Every other patch is as gentle as pieces are. Of the wild, an interval may begin or end among the hits, for
    // depths are about 4.
    const bool is_gentle = i % 2 == 0;
    const auto patch = random_patch<TestType>(random, random.uniform(0, is_gentle ? 0.1 : 1));
    Interval interval;
    if (!is_gentle) (random.index(2) == 0 ? interval.near : interval.far) = random.uniform(3, 5);
    NewtonFinish<TestType> nearest(patch_error, interval.near, interval.far, false,
                                   is_gentle ? closest : closest_of_wild);
    NewtonFinish<TestType> first(patch_error, interval.near, interval.far, false, is_gentle ? any : any_of_wild);
    first.settle_for_any();
    const bool has_hit = nearest.solve(Net(patch));
    CAPTURE(i, interval.near, interval.far);
    REQUIRE(first.solve(Net(patch)) == has_hit);
    if (!has_hit) continue;
    ++hits;
    const PatchHit& hit = first.hit();
    if (!hit.radius.allFinite()) continue;
    // A zero is where it is said to be: Newton's method from there, in the rectangle.
    Parameter at = hit.at;
    for (int step = 0; step < 30; ++step) {
      const Derivatives d = patch.derivatives(at);
      const Vec3 p = patch.position(at);
      Eigen::Matrix2d jacobian;
      jacobian << d.du.template head<2>(), d.dv.template head<2>();
      const Parameter change = jacobian.inverse() * p.template head<2>();
      at = (at - change).cwiseMax(hit.at - hit.radius).cwiseMin(hit.at + hit.radius);
    }
    CHECK(patch.position(at).template head<2>().norm() < 1e-12);
    const double distance = patch.position(at).z();
    CHECK(distance >= interval.near - 1e-12);
    CHECK(distance <= interval.far + 1e-12);
    off += (hit.at - at).norm() > 1e-6;
  }
  CHECK(hits > 1000);
  CHECK(off > hits / 4);
  // Of triangles, whose places are nearer to the sides, fewer hits are proven so.
  const double share = std::is_same_v<TestType, BezierQuad> ? 0.5 : 0.9;
  CHECK(static_cast<double>(any.newton_steps) < share * static_cast<double>(closest.newton_steps));
}

}  // namespace shaolin
