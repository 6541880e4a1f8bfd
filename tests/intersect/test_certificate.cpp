// What hits claim to be proven: true zeros are, false roots are not, and a certified error is never exceeded.
#include <functional>

#include "intersect/newton_finish.h"
#include "schemes/bezier_quad.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/aimed_rays.h"
#include "tests/intersect/hand_made_patches.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

namespace {

std::vector<PatchHit> all_hits(const BezierQuad& patch) {
  RayCounters counters;
  std::vector<PatchHit> hits;
  NewtonFinish<BezierQuad>(patch_error, 0, infinity, false, counters).solve(Net(patch), hits);
  return hits;
}

/// Folds along u = 1/2, the fold at x = -c: two zeros for c > 0, none below.
BezierQuad folded(double c) {
  constexpr std::array<double, 4> square{1, -1.0 / 3, -1.0 / 3, 1};  // the Bezier points of (2 u - 1)^2
  BezierQuad patch = quad([](double u, double v) { return Vec3(0, v - 0.4, 3 + 0.1 * u); });
  for (std::size_t k = 0; k < 16; ++k) patch.b[k].x() = square[k % 4] - c;
  return patch;
}

/// The zero of (x, y) next to `at`, to the digits of long double.
Eigen::Matrix<long double, 2, 1> zero_near(const BezierQuad& patch, const Parameter& start) {
  using Number = long double;
  Eigen::Matrix<Number, 2, 1> at = start.cast<Number>();
  const auto value = [&](Number u, Number v, Eigen::Index axis) {
    const auto weights = [](Number s) {
      const Number r = 1 - s;
      return std::array<Number, 4>{r * r * r, 3 * s * r * r, 3 * s * s * r, s * s * s};
    };
    const auto a = weights(u), b = weights(v);
    Number sum = 0;
    for (std::size_t k = 0; k < 16; ++k) sum += a[k % 4] * b[k / 4] * static_cast<Number>(patch.b[k][axis]);
    return sum;
  };
  constexpr Number h = 1e-7L;
  for (int step = 0; step < 12; ++step) {
    Eigen::Matrix<Number, 2, 2> jacobian;
    Eigen::Matrix<Number, 2, 1> f;
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
      f[axis] = value(at.x(), at.y(), axis);
      jacobian(axis, 0) = (value(at.x() + h, at.y(), axis) - value(at.x() - h, at.y(), axis)) / (2 * h);
      jacobian(axis, 1) = (value(at.x(), at.y() + h, axis) - value(at.x(), at.y() - h, axis)) / (2 * h);
    }
    at -= jacobian.inverse() * f;
  }
  return at;
}

/// Nothing is half proven.
bool is_proven(const PatchHit& hit) {
  CHECK((hit.radius.x() < 1) == (hit.radius.y() < 1));
  return hit.radius.maxCoeff() < 1;
}

}  // namespace

TEST_CASE("A proven zero is within its radius", "[intersect][certificate]") {
  Random random(301);
  int proven = 0, hits = 0;
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const double wildness = std::exp2(random.uniform(-9, -2)), size = std::exp2(random.uniform(-6, 1));
    const Vec3 shift = size * (0.5 * random.point() - Vec3(0.4, 0.4, 0)) + Vec3(0, 0, 4);
    const BezierQuad patch =
        quad([&](double u, double v) { return Vec3(size * (Vec3(u, v, 0) + wildness * random.point()) + shift); });
    for (const PatchHit& hit : all_hits(patch)) {
      ++hits;
      if (!is_proven(hit)) continue;
      ++proven;
      const auto zero = zero_near(patch, hit.at);
      const Parameter off = (zero - hit.at.cast<long double>()).cwiseAbs().cast<double>();
      worst = std::max(worst, off.cwiseQuotient(hit.radius).maxCoeff());
      REQUIRE((off.array() <= hit.radius.array()).all());
      CHECK(hit.radius.maxCoeff() <= 1e-9);  // some roundings of coordinates, over the patch's size
    }
  }
  CHECK(hits > 300);
  CHECK(proven >= 0.99 * hits);
  CHECK(worst > 1e-6);  // it is a bound, not a guess at infinity
}

TEST_CASE("False roots are not proven", "[intersect][certificate]") {
  SECTION("a fold that rounding cannot tell from the ray") {
    for (const double c :
         {-0.9 * patch_error, -0.5 * patch_error, -0.01 * patch_error, 0.0, 0.01 * patch_error, 0.9 * patch_error}) {
      const std::vector<PatchHit> hits = all_hits(folded(c));
      CAPTURE(c);
      REQUIRE(!hits.empty());  // it may be one: no hit is lost
      for (const PatchHit& hit : hits) CHECK(!is_proven(hit));
    }
  }
  SECTION("a fold well across the ray has two zeros, both proven") {
    const std::vector<PatchHit> hits = all_hits(folded(0.01));
    REQUIRE(hits.size() == 2);
    for (const PatchHit& hit : hits) CHECK(hit.radius.maxCoeff() < 1e-9);
  }
  SECTION("a patch that ends beside the ray, within rounding") {
    for (const double gap : {-0.5 * patch_error, 0.5 * patch_error, 0.9 * patch_error}) {
      const auto beside = [&](double u, double v) { return Vec3(u + gap, v - 0.4, 3); };
      for (const PatchHit& hit : all_hits(quad(beside))) {
        CHECK(is_proven(hit));
        CHECK(hit.at.x() - hit.radius.x() < 0);  // whether the zero lies in the patch is open
      }
    }
  }
  SECTION("a patch seen edge-on") {
    const auto edge_on = [](double u, double v) { return Vec3(0, v - 0.4, 3 + u); };
    const std::vector<PatchHit> hits = all_hits(quad(edge_on));
    REQUIRE(!hits.empty());
    for (const PatchHit& hit : hits) CHECK(!is_proven(hit));
  }
}

TEST_CASE("Hits are certified inside of faces and across smooth sides, not on creases and boundaries",
          "[intersect][certificate]") {
  const Vec3 direction = Vec3(0.3, -0.2, -1).normalized();
  const auto certified_at = [&](const Scene& scene, const SurfaceParameter& at) {
    const std::optional<LimitSample> sample = scene.surface().evaluate(at);
    REQUIRE(sample.has_value());
    const Vec3 way = sample->normal.dot(direction) > 0 ? Vec3(-direction) : direction;
    const std::optional<Hit> hit = scene.intersect({sample->position - 5 * way, way, 4.999, 5.001});
    REQUIRE(hit.has_value());
    CHECK(hit->certificate.residual < 1e-12);
    CHECK(hit->certificate.is_certified() == std::isfinite(hit->certificate.error));
    return hit->certificate.is_certified();
  };
  for (const std::string scheme : {"catmark", "loop"}) {
    CAPTURE(scheme);
    const Scene smooth(torus(scheme, 9, 7), scheme), creased(sheet(scheme, 5, 5), scheme);
    int sides = 0;
    for_each_patch(smooth.surface(), [&](int face, int sub) {
      CHECK(certified_at(smooth, {face, sub, 0.31, 0.23}));
      for (const double along : {0.0, 0.25, 0.6}) {
        CHECK(certified_at(smooth, on_side(smooth.surface(), face, sub, 0, along)));
        ++sides;
      }
    });
    CHECK(sides > 100);
    // The sheet's boundary: its first faces' first sides lie on it or not, by their vertices' positions.
    int on_boundary = 0;
    for_each_patch(creased.surface(), [&](int face, int sub) {
      for (std::size_t k = 0; k < (creased.surface().triangular() ? 3U : 4U); ++k) {
        const auto corners = creased.surface().control_mesh().face(face);
        int faces = 0;
        for (int f = 0; f < creased.surface().face_count(); ++f) {
          const auto other = creased.surface().control_mesh().face(f);
          faces += std::count(other.begin(), other.end(), corners[k]) > 0 &&
                   std::count(other.begin(), other.end(), corners[(k + 1) % corners.size()]) > 0;
        }
        if (faces != 1) continue;
        ++on_boundary;
        CHECK(!certified_at(creased, on_side(creased.surface(), face, sub, k, 0.4)));
      }
    });
    CHECK(on_boundary == 20);
  }
}

TEST_CASE("Random rays' hits are certified, on every model", "[intersect][certificate][sweep]") {
  for (const Model& model : all_models()) {
    CAPTURE(model.name);
    const Scene scene(model.mesh, model.scheme);
    const double diagonal = model.mesh.diagonal();
    std::uint64_t hits = 0, uncertified = 0;
    for (const Ray& ray : random_rays(scene.bounds(), 3000, 302)) {
      const std::optional<Hit> hit = scene.intersect(ray);
      if (!hit) continue;
      ++hits;
      CHECK(hit->certificate.residual <= 1e-13 * (diagonal + ray.origin.norm()));
      if (hit->certificate.is_certified()) {
        CHECK(hit->certificate.error > 0);
        CHECK(hit->certificate.error <= 1e-7 * diagonal);
      } else {
        ++uncertified;
      }
    }
    CHECK(scene.statistics().uncertified == uncertified);
    CHECK(scene.statistics().hits == hits);
    if (model.scheme == "catmark" || model.scheme == "loop") CHECK(uncertified <= 0.002 * static_cast<double>(hits));
  }
}

TEST_CASE("Certificates go with instances", "[intersect][certificate]") {
  const auto object = make_object(torus("catmark", 9, 7), "catmark");
  Affine map = Affine::Identity();
  map.linear() << 3, 0.5, 0, -0.2, 2, 0.1, 0, 0.3, 4;
  map.translation() << 10, -20, 5;
  const Scene scene({{object}, {object, map}});
  int certified = 0;
  for (const Ray& ray : random_rays(transformed(object->bounds(), map), 500, 303)) {
    const std::optional<Hit> hit = scene.intersect(ray);
    if (!hit || hit->instance != 1) continue;
    CHECK(hit->certificate.residual <= 1e-13 * (ray.origin.norm() + 30));
    const Vec3 away = hit->sample.position - ray.origin;
    CHECK(hit->certificate.residual ==
          Approx((away - away.dot(ray.direction.normalized()) * ray.direction.normalized()).norm()).margin(1e-14));
    if (!hit->certificate.is_certified()) continue;
    ++certified;
    CHECK(hit->certificate.error > 1e-16);
    CHECK(hit->certificate.error < 1e-7);  // the flattest of these rays
  }
  CHECK(certified > 100);
}

TEST_CASE("Any, all and inside count what they could not certify", "[intersect][certificate]") {
  const ControlMesh mesh = cube();
  const std::vector<SharpEdge> all_sharp = [&] {
    std::vector<SharpEdge> edges;
    for (int f = 0; f < mesh.face_count(); ++f)
      for (std::size_t i = 0; i < 4; ++i)
        if (const int a = mesh.face(f)[i], b = mesh.face(f)[(i + 1) % 4]; a < b) edges.push_back({a, b, 10});
    return edges;
  }();
  const Scene scene(with_edges(mesh, all_sharp), "bilinear");
  const Box box = scene.bounds();
  const Vec3 middle = box.centre(), edge(box.upper.x(), middle.y() + 0.1, box.upper.z());
  const Ray through_edge{edge + Vec3(1, 0.3, 2), -Vec3(1, 0.3, 2), 0, infinity};
  const Ray through_face{middle + Vec3(0.1, 0.2, 9), {0, 0, -1}, 0, infinity};
  const auto uncertified = [&] { return scene.statistics().uncertified; };
  CHECK(scene.occluded(through_face));
  CHECK(scene.all_hits(through_face).size() == 2);
  CHECK(uncertified() == 0);
  CHECK(scene.occluded(through_edge));
  CHECK(uncertified() == 1);
  const auto all = scene.all_hits(through_edge);
  CHECK(uncertified() == 1 + count_uncertified(all));
  CHECK(count_uncertified(all) >= 1);
}

}  // namespace shaolin
