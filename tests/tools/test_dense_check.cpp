// The dense check against what it must find: rays aimed at known points of the oracle's surface.
#include <cmath>
#include <limits>

#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/tools/oracle_models.h"
#include "tools/validate/dense_check.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin::oracle_test {

namespace {

double distance_from_line(const Vec3& p, const Vec3& origin, const Vec3& direction) {
  return (p - origin).cross(direction.normalized()).norm();
}

}  // namespace

TEST_CASE("the dense check finds the points that rays are aimed at, or nearer ones", "[tools][oracle]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    const OpenSubdivOracle oracle(model.mesh, model.scheme);
    const DenseCheck dense(oracle, 3);
    std::mt19937 random(8);
    int exact = 0;
    for (int i = 0; i < 60; ++i) {
      SurfaceParameter at = random_parameter(oracle, random);
      if (i % 5 == 0) at = towards_corner(at, oracle.triangular(), i / 5, 1e-3);
      if (i % 7 == 0) at.u = 0;  // on an edge
      const LimitSample target = *oracle.evaluate(at);
      const Vec3 tilt = 0.5 * target.derivatives->du.normalized();
      const Vec3 direction = -3 * oracle.diagonal() * (target.normal + tilt), origin = target.position - direction;
      const auto hit = dense.closest(origin, direction, 0, infinity);
      INFO("face " << at.face << " sub " << at.sub << " u " << at.u << " v " << at.v);
      REQUIRE(hit);
      CHECK(hit->t <= 1 + 1e-10);
      CHECK(distance_from_line(hit->sample.position, origin, direction) <= 1e-11 * oracle.diagonal());
      CHECK((oracle.evaluate(hit->at)->position - hit->sample.position).norm() == 0);
      exact += std::abs(hit->t - 1) <= 1e-10;
      // Behind the first point the interval's end hides it.
      CHECK_FALSE(dense.closest(origin, direction, 0, 0.9 * hit->t));
    }
    CHECK(exact > 15);
  }
}

TEST_CASE("the dense check takes rays past the surface for misses", "[tools][oracle]") {
  const OpenSubdivOracle oracle(shaken(cube(), 0.13), "catmark");
  const DenseCheck dense(oracle, 3);
  CHECK_FALSE(dense.closest({5, 5, 5}, {1, 0, 0}, 0, infinity));
  CHECK_FALSE(dense.closest({0, 0, 5}, {0, 0, 1}, 0, infinity));
  CHECK(dense.closest({0, 0, 5}, {0, 0, -1}, 0, infinity));
  CHECK(dense.closest({0, 0, 5}, {0, 0, 1}, -10, infinity));
  CHECK_THROWS(DenseCheck(oracle, 0));
}

TEST_CASE("the dense check tells grazing from transversal hits", "[tools][oracle]") {
  const OpenSubdivOracle oracle(shaken(cube(), 0.13), "catmark");
  const LimitSample sample = *oracle.evaluate({1, 0, 0.5, 0.5});
  const OracleHit hit{1, {1, 0, 0.5, 0.5}, sample};
  CHECK(is_transversal(hit, 7 * sample.normal));
  CHECK_FALSE(is_transversal(hit, 7 * sample.derivatives->du));
}

}  // namespace shaolin::oracle_test
