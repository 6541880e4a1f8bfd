// Both polynomial patches: conversion from the spline, evaluation, differentiation, splitting, hulls.
#include <cmath>

#include "schemes/bezier_quad.h"
#include "schemes/bezier_triangle.h"
#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "tests/property.h"
#include "tests/random.h"
#include "tests/random_patches.h"

namespace shaolin {

namespace {

/// u^i v^j and its derivatives, per unit of u and v.
struct Monomial {
  int i, j;
  static double power(double x, int n) { return n < 0 ? 0 : std::pow(x, n); }
  double operator()(const Parameter& p, int du = 0, int dv = 0) const {
    const auto falling = [](int n, int k) { return k == 0 ? 1.0 : k == 1 ? n : static_cast<double>(n) * (n - 1); };
    return falling(i, du) * power(p.x(), i - du) * falling(j, dv) * power(p.y(), j - dv);
  }
};

double binomial(int n, int k) {
  double result = 1;
  for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return result;
}

/// The Bezier points of a monomial, by the polar form: the ratio of binomials.
BezierQuad quad_of(const Monomial& m) {
  BezierQuad patch;
  for (int b = 0; b < 4; ++b)
    for (int a = 0; a < 4; ++a)
      patch.b[static_cast<std::size_t>(4 * b + a)] =
          Vec3::Constant(binomial(a, m.i) / binomial(3, m.i) * binomial(b, m.j) / binomial(3, m.j));
  return patch;
}
BezierTriangle triangle_of(const Monomial& m) {
  BezierTriangle patch;
  for (int b = 0; b <= 4; ++b)
    for (int a = 0; a + b <= 4; ++a)
      patch.b[BezierTriangle::index(a, b)] =
          Vec3::Constant(binomial(a, m.i) * binomial(b, m.j) / (binomial(4, m.i) * binomial(4 - m.i, m.j)));
  return patch;
}

template <class Bezier>
void check_monomial(const Bezier& patch, const Monomial& m, const Parameter& at) {
  const Derivatives d = patch.derivatives(at);
  CAPTURE(m.i, m.j, at.x(), at.y());
  CHECK(patch.position(at).x() == Approx(m(at)).margin(1e-14));
  CHECK(d.du.x() == Approx(m(at, 1, 0)).margin(1e-13));
  CHECK(d.dv.x() == Approx(m(at, 0, 1)).margin(1e-13));
  CHECK(d.duu.x() == Approx(m(at, 2, 0)).margin(1e-13));
  CHECK(d.duv.x() == Approx(m(at, 1, 1)).margin(1e-13));
  CHECK(d.dvv.x() == Approx(m(at, 0, 2)).margin(1e-13));
}

/// The uniform cubic B-spline over [0, 1].
std::array<double, 4> cubic_spline(double t) {
  return {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
          (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
}

}  // namespace

TEST_CASE("Both patches differentiate monomials exactly", "[schemes][bezier]") {
  Random random(1);
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; j <= 4; ++j)
      for (int round = 0; round < 5; ++round) {
        if (i < 4 && j < 4) check_monomial(quad_of({i, j}), {i, j}, random_parameter<BezierQuad::DomainType>(random));
        if (i + j <= 4)
          check_monomial(triangle_of({i, j}), {i, j}, random_parameter<BezierTriangle::DomainType>(random));
      }
}

TEMPLATE_TEST_CASE("Splitting agrees with evaluation", "[schemes][bezier]", BezierQuad, BezierTriangle) {
  using D = typename TestType::DomainType;
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const TestType patch = random_patch<TestType>(random);
    const auto children = patch.split();
    for (int k = 0; k < 4; ++k) {
      const TestType& child = children[static_cast<std::size_t>(k)];
      const Parameter at = random_parameter<typename TestType::DomainType>(random);
      const Parameter in_parent = D::to_parent(k, at);
      REQUIRE((child.position(at) - patch.position(in_parent)).norm() < 2e-15);
      const Derivatives a = child.derivatives(at), b = patch.derivatives(in_parent);
      const double s = D::scale(k);
      REQUIRE((a.du - s * b.du).norm() < 1e-14);
      REQUIRE((a.dv - s * b.dv).norm() < 1e-14);
      REQUIRE((a.duu - s * s * b.duu).norm() < 1e-13);
      REQUIRE((a.duv - s * s * b.duv).norm() < 1e-13);
      REQUIRE((a.dvv - s * s * b.dvv).norm() < 1e-13);
    }
  }
}

TEST_CASE("Halves of a triangle agree with evaluation", "[schemes][bezier]") {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    const BezierTriangle patch = random_patch<BezierTriangle>(random);
    for (int side = 0; side < 3; ++side) {
      const auto halves = patch.halves(side);
      for (const std::size_t k : {0u, 1u}) {
        // The corners of the half: that at the side's other end moves to the side's middle.
        std::array<Parameter, 3> corner{Parameter{0, 0}, Parameter{1, 0}, Parameter{0, 1}};
        const auto start = static_cast<std::size_t>(side), end = (start + 1) % 3;
        corner[k == 0 ? end : start] = 0.5 * (corner[start] + corner[end]);
        const Parameter at = random_parameter<BezierTriangle::DomainType>(random);
        const Parameter along_u = corner[1] - corner[0], along_v = corner[2] - corner[0];
        const Parameter in_parent = corner[0] + at.x() * along_u + at.y() * along_v;
        REQUIRE((halves[k].position(at) - patch.position(in_parent)).norm() < 2e-15);
        const Derivatives a = halves[k].derivatives(at), b = patch.derivatives(in_parent);
        REQUIRE((a.du - (along_u.x() * b.du + along_u.y() * b.dv)).norm() < 1e-14);
        REQUIRE((a.dv - (along_v.x() * b.du + along_v.y() * b.dv)).norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("Parts over any rectangle or triangle agree with evaluation", "[schemes][bezier]") {
  Random random(11);
  const auto is_same = [](const Vec3& a, const Vec3& b) { return (a - b).cwiseAbs().maxCoeff() <= 1e-14; };
  for (int trial = 0; trial < 50; ++trial) {
    BezierQuad quad;
    for (Vec3& point : quad.b) point = random.point();
    const Parameter a(random.uniform(), random.uniform()), b(random.uniform(), random.uniform());
    const BezierQuad part = quad.restricted(a.cwiseMin(b), a.cwiseMax(b));
    BezierTriangle triangle;
    for (Vec3& point : triangle.b) point = random.point();
    std::array<Parameter, 3> corners;
    for (Parameter& corner : corners) {
      corner = Parameter(random.uniform(), random.uniform());
      if (corner.sum() > 1) corner = Parameter::Ones() - corner;
    }
    const BezierTriangle third = triangle.restricted(corners);
    for (const Parameter& p : {Parameter(0, 0), Parameter(0.25, 0.5), Parameter(0.125, 0.75), Parameter(0, 1)}) {
      CHECK(is_same(part.position(p), quad.position(a.cwiseMin(b) + p.cwiseProduct((a - b).cwiseAbs()))));
      const Parameter there = (1 - p.sum()) * corners[0] + p.x() * corners[1] + p.y() * corners[2];
      CHECK(is_same(third.position(p), triangle.position(there)));
    }
  }
}

TEMPLATE_TEST_CASE("The domain's children invert each other", "[schemes][bezier][domain]", BezierQuad, BezierTriangle) {
  using D = typename TestType::DomainType;
  Random random(3);
  for (int round = 0; round < 2000; ++round) {
    const Parameter p = random_parameter<typename TestType::DomainType>(random);
    const ChildParameter inside = D::to_child(p);
    REQUIRE(D::contains(inside.at));
    REQUIRE((D::to_parent(inside.child, inside.at) - p).norm() <= 0x1p-53);
    const Parameter outside{random.uniform(-1, 2), random.uniform(-1, 2)};
    const Parameter nearest = D::nearest(outside);
    REQUIRE(D::contains(nearest));
    // The projection's defining property: no point of the domain is nearer.
    REQUIRE((outside - nearest).norm() <= (outside - p).norm() + 1e-15);
    REQUIRE(D::nearest(p) == p);
  }
}

TEMPLATE_TEST_CASE("Positions lie in the hull of the points, derivatives in that of the pairs", "[schemes][bezier]",
                   BezierQuad, BezierTriangle) {
  Random random(4);
  for (int round = 0; round < 200; ++round) {
    const TestType patch = random_patch<TestType>(random);
    const Vec3 n = random.direction();
    double high = -10, high_u = -100, high_v = -100;
    for (const Vec3& p : patch.b) high = std::max(high, n.dot(p));
    for (const auto& [from, to] : TestType::u_pairs)
      high_u = std::max(high_u, TestType::degree * n.dot(patch.b[to] - patch.b[from]));
    for (const auto& [from, to] : TestType::v_pairs)
      high_v = std::max(high_v, TestType::degree * n.dot(patch.b[to] - patch.b[from]));
    for (int i = 0; i < 50; ++i) {
      const Parameter at = random_parameter<typename TestType::DomainType>(random);
      const Derivatives d = patch.derivatives(at);
      REQUIRE(n.dot(patch.position(at)) <= high + 1e-14);
      REQUIRE(n.dot(d.du) <= high_u + 1e-13);
      REQUIRE(n.dot(d.dv) <= high_v + 1e-13);
    }
  }
}

TEMPLATE_TEST_CASE("The weights give position and first derivatives", "[schemes][bezier]", BezierQuad, BezierTriangle) {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    const TestType patch = random_patch<TestType>(random);
    const Parameter at = random_parameter<typename TestType::DomainType>(random);
    const auto w = TestType::weights(at);
    const Derivatives d = patch.derivatives(at);
    Vec3 value = Vec3::Zero(), du = value, dv = value;
    for (std::size_t i = 0; i < patch.b.size(); ++i) {
      value += w.value[i] * patch.b[i];
      du += w.du[i] * patch.b[i];
      dv += w.dv[i] * patch.b[i];
    }
    REQUIRE((value - patch.position(at)).norm() < 1e-14);
    REQUIRE((du - d.du).norm() < 1e-13);
    REQUIRE((dv - d.dv).norm() < 1e-13);
  }
}

TEST_CASE("The quad patch is the bicubic B-spline", "[schemes][bezier]") {
  check_property([] {
    std::array<Vec3, 16> points;
    for (Vec3& p : points) p = *any_point();
    const Parameter at((*coordinate() + 4) / 8, (*coordinate() + 4) / 8);
    const std::array<double, 4> u = cubic_spline(at.x()), v = cubic_spline(at.y());
    Vec3 expected = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t i = 0; i < 4; ++i) expected += v[j] * u[i] * points[4 * j + i];
    RC_ASSERT((BezierQuad::from_spline(points).position(at) - expected).norm() < 1e-14);
  });
}

TEST_CASE("The triangle patch is the box spline that Loop's regular masks refine", "[schemes][bezier]") {
  // Points on the lattice a + b w around the triangle (0, 0), (1, 0), (0, 1); refined points stand at half steps.
  using Place = std::array<int, 2>;
  constexpr std::array<Place, 12> places{
      {{0, 0}, {1, 0}, {0, 1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}, {0, -1}, {2, -1}, {2, 0}, {0, 2}, {-1, 2}}};
  // By definition of from_spline: p[3 + k] across edge k, then each corner's other two neighbours counter-clockwise.
  Random random(6);
  const auto find = [&](const Place& at) {
    return static_cast<std::size_t>(std::find(places.begin(), places.end(), at) - places.begin());
  };
  for (int round = 0; round < 50; ++round) {
    std::array<Vec3, 12> coarse;
    for (Vec3& p : coarse) p = random.point();
    const auto at = [&](int a, int b) -> const Vec3& { return coarse[find({a, b})]; };
    // A refined point at half steps (a, b): the box spline's two-scale relation, written with Loop's masks.
    const auto refined = [&](int a, int b) -> Vec3 {
      const bool odd_a = a & 1, odd_b = b & 1;
      const int x = (a - odd_a) / 2, y = (b - odd_b) / 2;
      if (!odd_a && !odd_b)
        return 5.0 / 8 * at(x, y) +
               1.0 / 16 *
                   (at(x + 1, y) + at(x, y + 1) + at(x - 1, y + 1) + at(x - 1, y) + at(x, y - 1) + at(x + 1, y - 1));
      if (odd_a && !odd_b) return 3.0 / 8 * (at(x, y) + at(x + 1, y)) + 1.0 / 8 * (at(x, y + 1) + at(x + 1, y - 1));
      if (!odd_a) return 3.0 / 8 * (at(x, y) + at(x, y + 1)) + 1.0 / 8 * (at(x + 1, y) + at(x - 1, y + 1));
      return 3.0 / 8 * (at(x + 1, y) + at(x, y + 1)) + 1.0 / 8 * (at(x, y) + at(x + 1, y + 1));
    };
    const auto children = BezierTriangle::from_spline(coarse).split();
    // Children by the origin of their lattice and its two directions.
    struct Frame {
      int a, b, sign;
    };
    constexpr std::array<Frame, 4> frames{{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, -1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<Vec3, 12> fine;
      for (std::size_t i = 0; i < 12; ++i)
        fine[i] = refined(frames[k].a + frames[k].sign * places[i][0], frames[k].b + frames[k].sign * places[i][1]);
      const BezierTriangle child = BezierTriangle::from_spline(fine);
      for (std::size_t i = 0; i < 15; ++i) REQUIRE((child.b[i] - children[k].b[i]).norm() < 1e-15);
    }
  }
}

}  // namespace shaolin
