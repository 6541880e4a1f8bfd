// Moving spheres first touch a surface when its distance is their radius, and not before.
#include "intersect/scene.h"
#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/intersect/dense_sampling.h"
#include "tests/intersect/shape_models.h"
#include "tests/plugins/plugin_files.h"

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

}  // namespace shaolin
