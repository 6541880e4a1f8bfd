/// NaN, infinity, denormal numbers and zero: a defined answer.
#include <limits>

#include "schemes/errors.h"
#include "tools/stress/bad_numbers.h"
#include "tools/stress/family.h"
#include "tools/stress/meshes.h"

namespace shaolin::stress {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), denormal = std::numeric_limits<double>::denorm_min();

double not_finite(SampleRandom& random) { return pick(std::vector{nan, infinity, -infinity}, random); }

template <class Act>
bool throws(const Act& act) {
  try {
    act();
  } catch (const InputError&) {
    return true;
  }
  return false;
}

class BadNumberStage final : public Stage {
 public:
  BadNumberStage(StressModel model, const QueriesOf& queries)
      : model_(std::move(model)), queries_(queries), subject_(std::make_unique<const Subject>(model_, queries)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    Check check(*subject_, "bad numbers", tally);
    const Aim aim = aim_anywhere(*subject_, random);
    const Ray sound = probe_at(*subject_, aim, random.direction(), random).ray;
    if (random.one_in(16)) return spoil_mesh(sound, random, check);
    const BadRay spoilt = spoiled(sound, random);
    const Ray& ray = spoilt.ray;
    const Expected expected = spoilt.expected;
    if (expected == Expected::sound) return check.ray({ray});
    const RayQueries& ask = subject_->queries();
    if (expected == Expected::miss) {
      if (ask.intersect(ray) || ask.occluded(ray) || !ask.all_hits(ray).empty())
        check.fail(Fault::ghost, ray, "a hit within an empty interval");
    } else if (!throws([&] { ask.intersect(ray); }) || !throws([&] { ask.occluded(ray); }) ||
               !throws([&] { ask.all_hits(ray); })) {
      check.fail(Fault::ghost, ray, "an answer to a ray that is none; expected InputError");
    }
  }

 private:
  /// A control point with a coordinate that is not finite must be refused; one that is denormal is a point.
  void spoil_mesh(const Ray& ray, SampleRandom& random, Check& check) const {
    StressModel model = model_;
    Vec3& point = model.mesh.positions[random.index(model.mesh.positions.size())];
    double& x = point[static_cast<Eigen::Index>(random.index(3))];
    if (random.one_in(2)) {
      x = denormal;
      const Subject spoilt(model, queries_, "a coordinate is denormal");
      if (const auto hit = spoilt.queries().intersect(ray); hit && !hit->sample.position.allFinite())
        check.fail(Fault::ghost, ray, "a hit that is no point: " + text(*hit));
      return;
    }
    x = not_finite(random);
    if (!throws([&] { Subject(model, queries_); }))
      check.fail(Fault::ghost, ray, "a mesh with a point that is not finite; expected InputError");
  }

  StressModel model_;
  QueriesOf queries_;
  std::unique_ptr<const Subject> subject_;
};

}  // namespace

BadRay spoiled(Ray ray, SampleRandom& random) {
  double& of_origin = ray.origin[static_cast<Eigen::Index>(random.index(3))];
  double& of_direction = ray.direction[static_cast<Eigen::Index>(random.index(3))];
  switch (random.index(11)) {
    case 0:
      of_origin = not_finite(random);
      return {ray, Expected::error};
    case 1:
      of_direction = not_finite(random);
      return {ray, Expected::error};
    case 2:
      ray.direction.setZero();
      return {ray, Expected::error};
    case 3:
      (random.one_in(2) ? ray.tmin : ray.tmax) = nan;
      return {ray, Expected::error};
    case 4:
      ray.tmin = infinity;
      return {ray, Expected::miss};
    case 5:
      ray.tmax = random.one_in(2) ? -infinity : -denormal;
      return {ray, Expected::miss};
    case 6:
      of_origin = random.one_in(2) ? denormal : -0.0;
      break;
    case 7:
      of_direction = random.one_in(2) ? -denormal : -0.0;
      if (ray.direction.isZero(0)) return {ray, Expected::error};
      break;
    case 8:
      ray.direction *= random.one_in(2) ? 1e-300 : 1e-320;
      if (ray.direction.isZero(0)) return {ray, Expected::error};
      break;
    case 9:
      ray.direction *= 1e300;
      break;
    default:
      (random.one_in(2) ? ray.tmin : ray.tmax) = denormal;
      break;
  }
  return {ray, Expected::sound};
}

std::vector<Family> bad_number_families() {
  const auto stage = [](const StressModel& model, const QueriesOf& queries) -> std::unique_ptr<const Stage> {
    return std::make_unique<BadNumberStage>(model, queries);
  };
  return {{"bad numbers", "NaN, infinity, denormal numbers and zero in rays and meshes", stage, sound_models}};
}

}  // namespace shaolin::stress
