/// Lines at random, and what origins inside and outside of closed surfaces see.
#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

/// From anywhere around the model through its box.
Probe random_line(const Subject& subject, SampleRandom& random) {
  const Box box = subject.box().expanded(0.25);
  const Vec3 origin = random.inside(box.lower, box.upper);
  const Vec3 to = random.one_in(2) ? aim_anywhere(subject, random).position
                                   : random.inside(subject.box().lower, subject.box().upper);
  const Vec3 way = to - origin;
  return {{origin, way.stableNorm() > 0 ? way : random.direction()}};
}

/// Around a point a closed surface winds as often as any ray from there leaves it more than it enters: two rays from
/// one origin must agree, one of them at a vertex or an edge; of an open surface, a ray and the line that it is half
/// of.
class OriginStage final : public Stage {
 public:
  explicit OriginStage(std::unique_ptr<const Subject> subject) : subject_(std::move(subject)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    const Box& box = subject_->box();
    const Vec3 origin = random.inside(box.lower, box.upper);
    const Ray any{origin, random.direction()};
    const Aim aim = aim_anywhere(*subject_, random);
    const Vec3 way = aim.position - origin;
    Check check(*subject_, "inside", tally);
    const Probe probe{{origin, way}, Probe::Target{1, aim.cosine(way.stableNormalized()), aim.is_crossed(way)}};
    check.ray(probe);
    // A ray that grazes the surface where it starts may begin on either side.
    const int one = check.winding(any), other = check.winding(probe.ray);
    if (one != other)
      check.fail(Fault::lost, probe.ray,
                 "its winding number is " + std::to_string(other) + ", that of the direction " +
                     std::to_string(any.direction.x()) + " " + std::to_string(any.direction.y()) + " " +
                     std::to_string(any.direction.z()) + " " + std::to_string(one));
  }

 private:
  std::unique_ptr<const Subject> subject_;
};

}  // namespace

std::vector<Family> parity_families() {
  const auto lines = [](const StressModel& model, const QueriesOf& queries) {
    return probe_stage("lines", std::make_unique<const Subject>(model, queries), random_line);
  };
  const auto inside = [](const StressModel& model, const QueriesOf& queries) -> std::unique_ptr<const Stage> {
    auto subject = std::make_unique<const Subject>(model, queries);
    return subject->is_closed() ? std::make_unique<OriginStage>(std::move(subject)) : nullptr;
  };
  return {{"lines", "anywhere: entering and leaving cancel", lines},
          {"inside", "from origins inside and outside, in two directions: the same winding number", inside}};
}

}  // namespace shaolin::stress
