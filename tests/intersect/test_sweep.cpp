// Moving spheres first touch a surface when its distance is their radius, and not before.
#include "intersect/scene.h"
#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/refusal.h"
#include "tests/intersect/shape_models.h"
#include "tests/plugins/plugin_files.h"
#include "tools/validate/dense_sampling.h"

namespace shaolin {

namespace {

bool same(const std::optional<SweepContact>& a, const std::optional<SweepContact>& b) {
  if (!a || !b) return !a && !b;
  return a->t == b->t && a->at.face == b->at.face && a->at.sub == b->at.sub && a->at.u == b->at.u &&
         a->at.v == b->at.v && a->instance == b->instance && a->sample.position == b->sample.position &&
         a->normal == b->normal && a->centre == b->centre;
}

/// From outside towards the surface, past it, through it, along it, away; of all sizes.
SphereSweep random_sweep(const Box& box, const Vec3& near, Random& random) {
  const double diagonal = (box.upper - box.lower).norm();
  const Vec3 start = box.centre() + 0.8 * (box.upper - box.lower).cwiseProduct(random.point());
  const Vec3 aim = near + std::exp2(random.uniform(-10, -2)) * diagonal * random.point();
  const double reach = random.uniform(0.5, 3);
  return {start, diagonal * std::exp2(random.uniform(-12, -2)), reach * (aim - start)};
}

/// The distance of the surfaces from where the sphere is at t.
double scene_distance(const Scene& scene, const SphereSweep& sweep, double t) {
  return scene.closest_point(sweep.start + t * sweep.displacement)->distance;
}

/// What a sweep's answer says, held against distances alone.
struct Faults {
  double early = 0;  ///< least distance, less than the radius, before the contact
  double off = 0;    ///< distance at the contact and the radius
  double inconsistent = 0;
  int missed = 0, started = 0, hit = 0;
};

void check_sweeps(const Model& model, int count) {
  const Scene scene(model.mesh, model.scheme);
  const LimitSurface& surface = scene.surface();
  const DenseSampling samples(surface, 3);
  const double diagonal = model.mesh.diagonal();
  Random random(31);
  Faults faults;
  std::uint64_t most = 0;
  for (int i = 0; i < count; ++i) {
    const auto& aim =
        samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))];
    const SphereSweep sweep = random_sweep(scene.bounds(), aim.position, random);
    const std::uint64_t before = scene.statistics().cells;
    const auto contact = scene.sweep(sweep);
    most = std::max(most, scene.statistics().cells - before);
    const double free_until = contact ? contact->t : 1;
    for (int k = 0; k < 24; ++k) {
      const double t = k == 0 ? 0.999 * free_until : free_until * random.uniform();
      const auto closest = scene.closest_point(sweep.start + t * sweep.displacement);
      if (free_until > 0) faults.early = std::max(faults.early, (sweep.radius - closest->distance) / diagonal);
    }
    if (!contact) {
      for (const auto& sample : samples.samples()) {
        const double along = std::clamp(
            (sample.position - sweep.start).dot(sweep.displacement) / sweep.displacement.squaredNorm(), 0.0, 1.0);
        faults.missed += (sample.position - sweep.start - along * sweep.displacement).norm() < sweep.radius;
      }
      continue;
    }
    ++faults.hit;
    faults.started += contact->t == 0;
    const double distance = scene.closest_point(contact->centre)->distance;
    if (contact->t > 0)
      faults.off = std::max(faults.off, std::abs(distance - sweep.radius) / diagonal);
    else
      CHECK(distance <= sweep.radius);
    faults.inconsistent = std::max(
        {faults.inconsistent, (surface.evaluate(contact->at)->position - contact->sample.position).norm() / diagonal,
         (sweep.start + contact->t * sweep.displacement - contact->centre).norm() / diagonal,
         ((contact->sample.position - contact->centre).norm() - distance) / diagonal});
  }
  CAPTURE(model.name, model.scheme, faults.hit, faults.started, most);
  CHECK(faults.early < 1e-12);
  CHECK(faults.off < 1e-12);
  CHECK(faults.inconsistent < 1e-12);
  CHECK(faults.missed == 0);
  CHECK(faults.hit > count / 4);
  CHECK(most < 40000);
}

}  // namespace

TEST_CASE("A moving sphere touches when the distance is its radius, and not before", "[intersect][sphere_sweep]") {
  for (const Model& model : shape_models()) check_sweeps(model, 30);
}

TEST_CASE("A moving sphere touches when the distance is its radius: all models", "[intersect][sphere_sweep][sweep]") {
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    if ((scene.bounds().lower.array() > scene.bounds().upper.array()).any()) continue;
    check_sweeps(model, 60);
  }
}

TEST_CASE("Against a plane, a moving sphere's contact is known", "[intersect][sphere_sweep]") {
  const Scene scene(sheet("bilinear", 4, 4), "bilinear");  // z = 0 over [0, 4]^2
  // Head on, at a slant, ending in contact, ending just before it, beside the sheet on to its edge, along it.
  const auto first = scene.sweep({{2, 2, 5}, 1, {0, 0, -8}});
  REQUIRE(first);
  CHECK(std::abs(first->t - 0.5) < 1e-14);
  CHECK((first->sample.position - Vec3(2, 2, 0)).norm() < 1e-14);
  CHECK((first->normal - Vec3::UnitZ()).norm() < 1e-14);
  const auto slant = scene.sweep({{1, 1, 5}, 1, {4, 4, -16}});
  REQUIRE(slant);
  CHECK(std::abs(slant->t - 0.25) < 1e-14);
  CHECK((slant->sample.position - Vec3(2, 2, 0)).norm() < 1e-13);
  CHECK(scene.sweep({{2, 2, 5}, 1, {0, 0, -4}}));
  CHECK(!scene.sweep({{2, 2, 5}, 1, {0, 0, -4 + 1e-9}}));
  const auto edge = scene.sweep({{-5, 2, 0.6}, 1, {8, 0, 0}});
  REQUIRE(edge);
  CHECK(std::abs(edge->t - (5 - 0.8) / 8) < 1e-14);
  CHECK((edge->sample.position - Vec3(0, 2, 0)).norm() < 1e-13);
  CHECK((edge->normal - Vec3(-0.8, 0, 0.6)).norm() < 1e-13);
  // Grazing: it touches the whole way, from where it comes over the edge, or never.
  const auto grazing = scene.sweep({{-5, 2, 1}, 1, {20, 0, 0}});
  REQUIRE(grazing);
  CHECK(std::abs(scene.closest_point(grazing->centre)->distance - 1) < 1e-13);
  CHECK(!scene.sweep({{-5, 2, 1 + 1e-9}, 1, {20, 0, 0}}));
  CHECK(scene.sweep({{-5, 2, 1 - 1e-9}, 1, {20, 0, 0}}));
  CHECK(scene.statistics().cells < 200000);
}

TEST_CASE("A moving sphere meets a surface that is collapsed to a curve", "[intersect][sphere_sweep]") {
  ControlMesh thin = sheet("catmark", 3, 3);
  for (Vec3& p : thin.positions) p = Vec3(p.x(), 0.2 * p.x() * p.x(), 0);
  const Scene scene(thin, "catmark");
  Random random(35);
  for (int i = 0; i < 12; ++i) {
    const Vec3 p = Vec3(1.5, 0.8, 0) + 2 * random.point();
    const auto closest = scene.closest_point(p);
    const std::uint64_t before = scene.statistics().cells;
    const auto contact = scene.sweep({p, 0.01, 1.5 * (closest->sample.position - p)});
    CAPTURE(i);
    CHECK(scene.statistics().cells - before < 5000);
    REQUIRE(contact);
    CHECK(std::abs(scene.closest_point(contact->centre)->distance - 0.01) < 1e-12);
  }
}

TEST_CASE("A sphere that meets the surface at its start does so at t = 0", "[intersect][sphere_sweep]") {
  const Scene scene(cube(), "catmark");
  for (const Vec3& displacement : {Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(-9, 0, 0)}) {
    const auto contact = scene.sweep({{0, 0, 0.9}, 0.5, displacement});
    REQUIRE(contact);
    CHECK(contact->t == 0);
    CHECK(contact->centre == Vec3(0, 0, 0.9));
    CHECK((contact->sample.position - scene.closest_point({0, 0, 0.9})->sample.position).norm() == 0);
  }
  CHECK(!scene.sweep({{0, 0, 5}, 0.5, {0, 0, 0}}));
  const Vec3 on = scene.closest_point({0, 0, 9})->sample.position;
  const auto there = scene.sweep({on, 1e-3, {0, 0, 1}});
  REQUIRE(there);
  CHECK((there->normal - Vec3::UnitZ()).norm() < 1e-9);
}

TEST_CASE("An instance's first contact is that of the mapped mesh", "[intersect][sphere_sweep][instances]") {
  Random random(32);
  for (const Model& model : {Model{"cube", "catmark", shaken(cube(), 0.2)}, Model{"poles", "loop", poles("loop", 7)},
                             Model{"sheet", "catmark", shaken(sheet("catmark", 3, 3), 0.3)}}) {
    const auto object = make_object(model.mesh, model.scheme);
    for (int k = 0; k < 6; ++k) {
      const Affine map = random_affine(random), other = random_affine(random);
      const Scene both(std::vector<Instance>{{object, other}, {object, map}});
      const Scene one(image_of(model.mesh, other), model.scheme), two(image_of(model.mesh, map), model.scheme);
      const double diagonal = (both.bounds().upper - both.bounds().lower).norm();
      double differ = 0;
      int wrong = 0;
      for (int i = 0; i < 60; ++i) {
        const SphereSweep sweep = random_sweep(both.bounds(), two.bounds().centre(), random);
        const auto contact = both.sweep(sweep), first = one.sweep(sweep), second = two.sweep(sweep);
        wrong += contact.has_value() != (first || second);
        if (!contact || !(first || second)) continue;
        const double expected = std::min(first ? first->t : 2, second ? second->t : 2);
        differ = std::max(differ, std::abs(scene_distance(both, sweep, contact->t) - sweep.radius) / diagonal *
                                      (contact->t > 0 ? 1 : 0));
        wrong += std::abs(contact->t - expected) > 1e-6;  // a grazing contact's time is known to the root of rounding
      }
      CAPTURE(model.name, k);
      CHECK(wrong == 0);
      CHECK(differ < 1e-12);
    }
  }
}

TEST_CASE("A first contact does not depend on what was asked before, or on threads", "[intersect][sphere_sweep]") {
  Random random(33);
  const ControlMesh mesh = shaken(poles("catmark", 9), 0.2);
  const Scene fresh(mesh, "catmark"), backwards(mesh, "catmark");
  std::vector<SphereSweep> sweeps;
  for (int i = 0; i < 200; ++i) sweeps.push_back(random_sweep(fresh.bounds(), {0, 0, 0}, random));
  const auto all = fresh.sweep(sweeps), again = fresh.sweep(sweeps);
  int differ = 0;
  for (std::size_t i = sweeps.size(); i-- > 0;) {
    const auto single = backwards.sweep(sweeps[i]);
    differ += !same(single, all[i]) || !same(single, again[i]);
  }
  CHECK(differ == 0);
}

TEST_CASE("Moving spheres meet surfaces without polynomials", "[intersect][sphere_sweep][plugin]") {
  Random random(34);
  for (const bool quads : {false, true}) {
    const auto masks = load_plugin(test::example_plugin(quads ? "kobbelt" : "butterfly")).masks;
    const Scene scene(quads ? shaken(cube(), 0.1) : shaken(tetrahedron(), 0.1), masks);
    for (int i = 0; i < 4; ++i) {
      const Vec3 start = 3 * random.direction();
      const auto contact = scene.sweep({start, 0.25, -start});
      CAPTURE(quads, i);
      REQUIRE(contact);
      CHECK(std::abs(scene.closest_point(contact->centre)->distance - 0.25) < 1e-10);
    }
  }
}

TEST_CASE("Sweeps that are none are refused, and nothing is met in an empty scene", "[intersect][sphere_sweep]") {
  const Scene scene(cube(), "catmark");
  const double nan = std::nan(""), most = 1.7e308;
  const std::vector<std::pair<SphereSweep, std::string>> bad{
      {{{nan, 0, 0}, 1, {1, 0, 0}}, "is not finite"},
      {{{0, 0, 0}, 1, {1, infinity, 0}}, "is not finite"},
      {{{most, 0, 0}, 1, {most, 0, 0}}, "is not finite"},
      {{{0, 0, 0}, 0, {1, 0, 0}}, "expected a positive length"},
      {{{0, 0, 0}, -1, {1, 0, 0}}, "expected a positive length"},
      {{{0, 0, 0}, nan, {1, 0, 0}}, "expected a positive length"}};
  for (const auto& [sweep, message] : bad) {
    const SphereSweep one = sweep;
    CAPTURE(message);
    CHECK(refusal_of([&] { scene.sweep(one); }).find(message) != std::string::npos);
    const std::vector<SphereSweep> all{{{0, 0, 9}, 1, {0, 0, 1}}, one};
    CHECK(refusal_of([&] { scene.sweep(all); }).find("sweep 1: ") == 0);
  }
  CHECK(!Scene(std::vector<Instance>{}).sweep({{0, 0, 0}, 9, {1, 0, 0}}));
}

}  // namespace shaolin
