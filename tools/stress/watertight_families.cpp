/// Embree's watertight set-up: rays from inside of a sphere that is far away. Embree's own bar is 2e-5 misses.
#include "tools/stress/family.h"
#include "tools/stress/meshes.h"

namespace shaolin::stress {

namespace {

/// From the sphere's inner half; every third at a vertex or an edge. Each leaves the sphere once.
class InsideStage final : public Stage {
 public:
  explicit InsideStage(std::unique_ptr<const Subject> subject) : subject_(std::move(subject)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    // A cube of side 1 about the middle of a sphere of radius 1.9 or more: some 1 away from the surface.
    const Vec3 half = Vec3::Constant(0.5), middle = subject_->box().centre();
    const Vec3 origin = random.inside(middle - half, middle + half);
    const Vec3 way = random.one_in(3) ? Vec3(aim_anywhere(*subject_, random).position - origin) : random.direction();
    Check check(*subject_, "watertight", tally);
    const Ray ray{origin, way};
    check.ray({ray});
    const std::optional<Hit> hit = subject_->queries().intersect(ray);
    if (!hit) return check.fail(Fault::lost, ray, "no hit from inside of the sphere");
    const int winding = check.winding(ray);
    if (winding != 1)
      check.fail(winding < 1 ? Fault::lost : Fault::duplicate, ray,
                 "leaves the sphere " + std::to_string(winding) + " times");
  }

 private:
  std::unique_ptr<const Subject> subject_;
};

}  // namespace

std::vector<Family> watertight_families() {
  const auto stage = [](const StressModel& model, const QueriesOf& queries) -> std::unique_ptr<const Stage> {
    return std::make_unique<InsideStage>(std::make_unique<const Subject>(model, queries));
  };
  return {{"watertight", "from inside of a sphere at (148376, 1234, -223423)", stage, distant_spheres}};
}

}  // namespace shaolin::stress
