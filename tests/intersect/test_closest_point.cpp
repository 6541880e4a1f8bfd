// Closest points are those of brute force, of analytic surfaces and of every other way to say the same.
#include <functional>

#include "intersect/bvh.h"
#include "intersect/nearest_finish.h"
#include "intersect/scene.h"
#include "schemes/errors.h"
#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/hand_made_patches.h"
#include "tests/intersect/random_affine.h"
#include "tests/intersect/refusal.h"
#include "tests/models.h"
#include "tests/plugins/plugin_files.h"
#include "tools/validate/dense_sampling.h"

namespace shaolin {

namespace {

bool same(const std::optional<ClosestPoint>& a, const std::optional<ClosestPoint>& b) {
  if (!a || !b) return !a && !b;
  return a->distance == b->distance && a->at.face == b->at.face && a->at.sub == b->at.sub && a->at.u == b->at.u &&
         a->at.v == b->at.v && a->level == b->level && a->instance == b->instance &&
         a->sample.position == b->sample.position && a->sample.normal == b->sample.normal;
}

/// In the box and around it, far off, near the surface and on it, in corners and over them.
Vec3 random_point(const Box& box, const DenseSampling& samples, const LimitSurface& surface, Random& random) {
  const Vec3 size = box.upper - box.lower;
  DenseSampling::Sample sample =
      samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))];
  const double diagonal = size.norm();
  switch (random.index(8)) {
    case 0:
      return box.centre() + 4 * diagonal * random.direction();
    case 1:
      return sample.position + 1e-3 * diagonal * random.point();
    case 2:
      return sample.position + 0.05 * diagonal * random.point();
    case 3:
      return sample.position;
    case 4:
    case 5: {
      sample.at.u = random.index(2);
      sample.at.v = surface.triangular() && sample.at.u > 0 ? 0 : random.index(2);
      const LimitSample corner = *surface.evaluate(sample.at);
      return corner.position + 0.05 * diagonal * random.index(2) * random.uniform(-1, 1) * corner.normal;
    }
    default:
      return box.centre() + 0.6 * size.cwiseProduct(random.point());
  }
}

/// Models that are small, and between them everything that a surface can have.
std::vector<Model> test_models() {
  static const std::vector<std::string> names{"torus",
                                              "cube_creases",
                                              "dart",
                                              "ngon_body",
                                              "sail",
                                              "saddle",
                                              "tetrahedron",
                                              "catmark_pawn",
                                              "catmark_xord_boundary",
                                              "catmark_chaikin0",
                                              "catmark_cubes_semisharp",
                                              "catmark_val2_interior",
                                              "loop_val2_interior",
                                              "loop_cubes_semisharp",
                                              "loop_saddle_edgecorner",
                                              "spot_catmark"};
  std::vector<Model> models;
  for (const Model& model : all_models())
    if (std::find(names.begin(), names.end(), model.name) != names.end()) models.push_back(model);
  models.push_back({"poles", "catmark", shaken(poles("catmark", 9), 0.2)});
  models.push_back({"pillow", "loop", pillow()});
  return models;
}

/// Of one model, against brute force and itself.
struct ClosestDifferences {
  double farther = -infinity;  ///< than brute force, in units of the diagonal
  double inconsistent = 0;     ///< position, parameter and distance
  double oblique = 0;          ///< |cosine| of the way to the point with tangents, inside of patches

  void add(const ClosestPoint& closest, double expected, const Vec3& p, const LimitSurface& surface, double diagonal) {
    farther = std::max(farther, (closest.distance - expected) / diagonal);
    const LimitSample sample = *surface.evaluate(closest.at);
    inconsistent = std::max({inconsistent, (sample.position - closest.sample.position).norm() / diagonal,
                             std::abs((closest.sample.position - p).norm() - closest.distance) / diagonal});
    const double side =
        surface.triangular() ? 1 - closest.at.u - closest.at.v : std::min(1 - closest.at.u, 1 - closest.at.v);
    if (!closest.sample.derivatives || std::min({closest.at.u, closest.at.v, side}) < 1e-3) return;
    const Vec3 way = closest.sample.position - p;
    if (way.norm() < 1e-3 * diagonal) return;
    for (const Vec3& tangent : {closest.sample.derivatives->du, closest.sample.derivatives->dv})
      if (tangent.norm() > 1e-3 * diagonal)
        oblique = std::max(oblique, std::abs(way.dot(tangent)) / way.norm() / tangent.norm());
  }
};

void check_closest_against_brute_force(const Model& model, int count, int steps) {
  const Scene scene(model.mesh, model.scheme);
  const LimitSurface& surface = scene.surface();
  const DenseSampling samples(surface, steps);
  const double diagonal = model.mesh.diagonal();
  Random random(11);
  ClosestDifferences differences;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random_point(scene.bounds(), samples, surface, random);
    const auto closest = scene.closest_point(p);
    REQUIRE(closest);
    differences.add(*closest, samples.distance(p), p, surface, diagonal);
  }
  CAPTURE(model.name, model.scheme);
  CHECK(differences.farther < 1e-12);
  CHECK(differences.inconsistent < 1e-13);
  CHECK(differences.oblique < 1e-5);
}

}  // namespace

TEST_CASE("The closest point is that of brute force", "[intersect][closest][sweep]") {
  for (const Model& model : test_models()) check_closest_against_brute_force(model, 24, 6);
}

TEST_CASE("The closest point is that of brute force: all models, many points", "[intersect][closest][sweep]") {
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    if ((scene.bounds().lower.array() > scene.bounds().upper.array()).any()) continue;
    check_closest_against_brute_force(model, 60, model.mesh.face_count() > 1500 ? 4 : 8);
  }
}

TEST_CASE("No point of the surface is nearer than the closest", "[intersect][closest]") {
  Random random(12);
  for (const Model& model : test_models()) {
    const Scene scene(model.mesh, model.scheme);
    const LimitSurface& surface = scene.surface();
    const DenseSampling samples(surface, 4);
    int nearer = 0;
    for (int i = 0; i < 60; ++i) {
      const Vec3 p = random_point(scene.bounds(), samples, surface, random);
      const double distance = scene.closest_point(p)->distance;
      for (const auto& sample : samples.samples())
        nearer += (sample.position - p).norm() < distance - 1e-13 * model.mesh.diagonal();
    }
    CAPTURE(model.name);
    CHECK(nearer == 0);
  }
}

TEST_CASE("Of a box that stays a box, distances are known", "[intersect][closest]") {
  Random random(13);
  ControlMesh box = cube();
  const Vec3 half(1, 2, 0.5);
  for (Vec3& p : box.positions) p = p.cwiseProduct(half);
  const Scene scene(box, "bilinear");
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    Vec3 p = 3 * random.point();
    if (i % 4 == 0) p = half.cwiseProduct(Vec3(random.index(3) - 1, random.index(3) - 1, random.index(3) - 1));
    const Vec3 beyond = p.cwiseAbs() - half;
    const double expected = beyond.maxCoeff() > 0 ? beyond.cwiseMax(0.0).norm() : -beyond.maxCoeff();
    const auto closest = scene.closest_point(p);
    REQUIRE(closest);
    worst = std::max(worst, std::abs(closest->distance - expected));
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("A flat sheet is met straight below, beyond its border at the border", "[intersect][closest]") {
  for (const char* scheme : {"catmark", "loop"}) {
    const Scene scene(with_boundary(sheet(scheme, 4, 3), BoundaryInterpolation::edge_and_corner), scheme);
    const auto above = scene.closest_point({1.3, 1.1, 0.7}), beside = scene.closest_point({1.3, -2, 0}),
               corner = scene.closest_point({-3, -4, 0});
    REQUIRE((above && beside && corner));
    CHECK(std::abs(above->distance - 0.7) < 1e-15);
    CHECK((above->sample.position - Vec3(1.3, 1.1, 0)).norm() < 1e-14);
    CHECK(std::abs(std::abs(above->sample.normal.z()) - 1) < 1e-15);
    CHECK(std::abs(beside->distance - 2) < 1e-15);
    if (scheme == std::string("catmark")) CHECK(std::abs(corner->distance - 5) < 1e-14);  // of one face, hence sharp
  }
}

TEST_CASE("Far away and huge, distances keep their digits", "[intersect][closest]") {
  Random random(14);
  const ControlMesh mesh = shaken(poles("catmark", 5), 0.2);
  const Scene scene(mesh, "catmark");
  for (const double scale : {1e-150, 1e-9, 1e9, 1e150}) {
    ControlMesh scaled = mesh;
    for (Vec3& p : scaled.positions) p *= scale;
    const Scene other(scaled, "catmark");
    double worst = 0;
    for (int i = 0; i < 30; ++i) {
      const Vec3 p = 3 * random.point();
      worst = std::max(worst,
                       std::abs(other.closest_point(scale * p)->distance / scale - scene.closest_point(p)->distance));
    }
    CAPTURE(scale);
    CHECK(worst < 1e-13);
  }
  ControlMesh shifted = mesh;
  for (Vec3& p : shifted.positions) p += Vec3(1e9, -1e9, 1e9);
  const Scene other(shifted, "catmark");
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    const Vec3 p = 3 * random.point();
    worst = std::max(
        worst, std::abs(other.closest_point(p + Vec3(1e9, -1e9, 1e9))->distance - scene.closest_point(p)->distance));
  }
  CHECK(worst < 32 * 1e9 * 0x1p-52);
  const DenseSampling samples(scene.surface(), 8);
  for (const double distance : {1e6, 1e12, 1e100, 1e300}) {
    const Vec3 p = distance * random.direction();
    const auto closest = scene.closest_point(p);
    REQUIRE(closest);
    CAPTURE(distance);
    CHECK(closest->distance <= (1 + 1e-14) * p.stableNorm() + 4);
    double nearest = infinity;
    for (const auto& sample : samples.samples()) nearest = std::min(nearest, (sample.position - p).stableNorm());
    CHECK(closest->distance <= nearest * (1 + 1e-14));
  }
}

TEST_CASE("Distances from instances are those from the transformed control mesh", "[intersect][closest][instances]") {
  Random random(15);
  for (const Model& model :
       {Model{"torus", "catmark", shaken(torus("catmark", 4, 6), 0.1)},
        Model{"poles", "loop", shaken(poles("loop", 7), 0.2)}, Model{"fan", "loop", shaken(fan("loop", 4), 0.2)}}) {
    const auto object = make_object(model.mesh, model.scheme);
    for (int round = 0; round < 4; ++round) {
      const Affine map = random_affine(random, 3);
      const ControlMesh twin = image_of(model.mesh, map);
      const Scene scene({{object, map}}), expected(twin, model.scheme);
      const double size = twin.diagonal() + map.translation().norm();  // what coordinates round by
      double worst = 0, normal = 0;
      for (int i = 0; i < 40; ++i) {
        const Box box = expected.bounds();
        const Vec3 p = box.centre() + 0.8 * (box.upper - box.lower).cwiseProduct(random.point());
        const auto a = scene.closest_point(p), b = expected.closest_point(p);
        REQUIRE((a && b));
        worst = std::max(worst, std::abs(a->distance - b->distance) / size);
        if ((a->sample.position - b->sample.position).norm() < 1e-9 * twin.diagonal())
          normal = std::max(normal, std::min((a->sample.normal - b->sample.normal).norm(),
                                             (a->sample.normal + b->sample.normal).norm()));
      }
      CAPTURE(model.name, round, 1e15 * worst);
      CHECK(worst < 1e-13);
      CHECK(normal < 1e-6);
    }
  }
}

TEST_CASE("Among many instances the closest one to a point answers, with its index",
          "[intersect][closest][instances]") {
  Random random(16);
  const auto one = make_object(shaken(prism(5), 0.1), "catmark"), other = make_object(tetrahedron(), "loop");
  std::vector<Instance> instances;
  std::vector<Scene> alone;
  for (int i = 0; i < 40; ++i) {
    Affine map = random_affine(random, 3);
    map.translation() = 12 * random.point();
    instances.push_back({i % 2 ? one : other, map});
    alone.emplace_back(std::vector<Instance>{instances.back()});
  }
  const Scene scene(instances);
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = 14 * random.point();
    double nearest = infinity;
    for (const Scene& single : alone) nearest = std::min(nearest, single.closest_point(p)->distance);
    const auto closest = scene.closest_point(p);
    REQUIRE(closest);
    const double own = alone[static_cast<std::size_t>(closest->instance)].closest_point(p)->distance;
    wrong += std::abs(closest->distance - nearest) > 1e-13 * 24 || std::abs(own - nearest) > 1e-13 * 24;
  }
  CHECK(wrong == 0);
}

TEST_CASE("A radius is looked through and not beyond", "[intersect][closest]") {
  Random random(17);
  const Scene scene(shaken(poles("catmark", 5), 0.2), "catmark");
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 p = 3 * random.point();
    const auto closest = scene.closest_point(p);
    wrong += scene.closest_point(p, closest->distance * (1 - 1e-9)).has_value();
    for (const double radius : {closest->distance * (1 + 1e-9), 2 * closest->distance, closest->distance}) {
      const auto within = scene.closest_point(p, radius);
      wrong += !within || within->distance > radius || std::abs(within->distance - closest->distance) > 1e-14;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("An answer does not depend on what was asked before, or on threads", "[intersect][closest]") {
  Random random(18);
  for (const Model& model : {Model{"cube", "catmark", cube()}, Model{"poles", "loop", poles("loop", 9)},
                             Model{"prism", "catmark", shaken(prism(5), 0.1)}}) {
    const Scene fresh(model.mesh, model.scheme);
    std::vector<Vec3> points{Vec3::Zero(), {0, 0, 0.5}, {0, 0, 3}, {1, 1, 1}};
    for (int i = 0; i < 200; ++i) points.push_back(2 * random.point());
    const auto all = fresh.closest_points(points);
    const auto again = fresh.closest_points(points);
    const Scene backwards(model.mesh, model.scheme);
    int differ = 0;
    for (std::size_t i = points.size(); i-- > 0;) {
      const auto single = backwards.closest_point(points[i]);
      differ += !same(single, all[i]) || !same(single, again[i]);
    }
    CAPTURE(model.name);
    CHECK(differ == 0);
    CHECK(fresh.statistics().points == 2 * points.size());
  }
}

TEST_CASE("Faces that are segments or points have closest points", "[intersect][closest]") {
  ControlMesh mesh = sheet("catmark", 3, 3);
  mesh.positions[5] = mesh.positions[6] = mesh.positions[9] = mesh.positions[10];
  ControlMesh thin = sheet("catmark", 3, 3);
  for (Vec3& p : thin.positions) p = Vec3(p.x(), 0.2 * p.x() * p.x(), 0);
  Random random(19);
  for (const ControlMesh& degenerate : {mesh, thin}) {
    const Scene scene(degenerate, "catmark");
    const DenseSampling samples(scene.surface(), 12);
    double farther = -infinity;
    for (int i = 0; i < 12; ++i) {
      const Vec3 p = Vec3(1.5, 0.8, 0) + 2 * random.point();
      const auto closest = scene.closest_point(p);
      REQUIRE(closest);
      farther = std::max(farther, closest->distance - samples.distance(p));
    }
    CHECK(farther < 1e-12);
  }
}

TEST_CASE("Surfaces without polynomials have closest points", "[intersect][closest][plugin]") {
  Random random(20);
  for (const bool quads : {false, true}) {
    const auto masks = load_plugin(test::example_plugin(quads ? "kobbelt" : "butterfly")).masks;
    const ControlMesh mesh = quads ? shaken(cube(), 0.1) : shaken(tetrahedron(), 0.1);
    const Scene scene(mesh, masks);
    const DenseSampling samples(scene.surface(), 6);
    double farther = -infinity;
    for (int i = 0; i < 6; ++i) {
      const Vec3 p = 2 * random.point();
      const auto closest = scene.closest_point(p);
      REQUIRE(closest);
      farther = std::max(farther, (closest->distance - samples.distance(p)) / mesh.diagonal());
    }
    CAPTURE(quads);
    CHECK(farther < 1e-12);
  }
}

TEST_CASE("Questions that have no answer are refused, or are empty", "[intersect][closest]") {
  const Scene scene(cube(), "catmark");
  CHECK(refusal_of([&] { scene.closest_point({0, std::nan(""), 0}); }).find("is not finite") != std::string::npos);
  CHECK(refusal_of([&] { scene.closest_point({0, infinity, 0}); }).find("is not finite") != std::string::npos);
  for (const double radius : {0.0, -1.0, std::nan("")})
    CHECK(refusal_of([&] {
            scene.closest_point({0, 0, 0}, radius);
          }).find("expected a positive length") != std::string::npos);
  const std::vector<Vec3> points{{0, 0, 0}, {infinity, 0, 0}};
  CHECK(refusal_of([&] { scene.closest_points(points); }).find("point 1: ") == 0);

  SceneOptions chord;
  chord.method = Method::chord;
  SceneOptions uniform;
  uniform.method = Method::uniform;
  for (const SceneOptions& options : {chord, uniform})
    CHECK(refusal_of([&] {
            Scene(cube(), "catmark", options).closest_point({0, 0, 0});
          }).find("Method::exact") != std::string::npos);

  CHECK(!Scene(std::vector<Instance>{}).closest_point({0, 0, 0}));
  ControlMesh hole = sheet("catmark", 1, 1);
  hole.holes = {0};
  CHECK(!Scene(hole, "catmark").closest_point({0, 0, 0}));
}

TEST_CASE("Coefficients of the squared distance bound it, where the search inlines them", "[intersect][closest]") {
  // A flat bilinear patch, seen from a place of its own. Sums of overlapping rows by SSE2's pairs came out wrong at
  // -O3, so that the patch was dropped for being too far; found by "Instruction sets give the same crossings".
  const Vec3 a{0.01679671441634247, 1.0229008767573117e-15, -0.0030052259080615845},
      b{0.02242171441634247, 1.0229008767573117e-15, 0.014494774091938415},
      c{-0.0016407855836575308, 1.0229008767573117e-15, -0.0030052259080615845},
      d{-0.0016407855836575308, 1.0229008767573117e-15, 0.022307274091938417};
  const BezierQuad patch =
      quad([&](double u, double v) { return Vec3((1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d)); });
  Box box;
  for (const Vec3& point : patch.b) box.add(point);
  const Bvh hierarchy(std::vector<Box>{box});
  const Placement here(Affine::Identity());
  for (const double radius : {1e-6, 1.25e-4, 1e-3, 1.0}) {
    RayCounters counters;
    PointApproach approach({Vec3::Zero(), here, radius}, box, hierarchy.space(), counters);
    Net relative;
    approach.relative(Net(patch), relative);
    NearestFinish<BezierQuad> finish(1e-16, approach);
    CAPTURE(radius);
    CHECK(finish.solve(relative));
  }
}

}  // namespace shaolin
