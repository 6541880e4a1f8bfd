/// Meshes that no modeller makes on purpose, and every sharpness and valence.
#include "tools/stress/family.h"
#include "tools/stress/meshes.h"

namespace shaolin::stress {

namespace {

/// Two in three are aimed, the others lines through the box.
Probe aimed_or_line(const Subject& subject, Random& random) {
  const Aim aim = aim_anywhere(subject, random);
  if (random.index(3) > 0) return probe_at(subject, aim, direction_at(subject, aim, random), random);
  const Box& box = subject.box();
  const Vec3 origin = box.centre() + 2 * subject.diagonal() * random.direction();
  const Vec3 way = random.inside(box.lower, box.upper) - origin;
  return {{origin, way.stableNorm() > 0 ? way : random.direction()}};
}

Family family_of(const std::string& name, const std::string& meaning, std::vector<StressModel> (*models)()) {
  const auto stage = [name](const StressModel& model, const QueriesOf& queries) {
    return probe_stage(name, std::make_unique<const Subject>(model, queries), aimed_or_line);
  };
  return {name, meaning, stage, models};
}

}  // namespace

std::vector<Family> degenerate_families() {
  return {family_of("degenerate", "slivers, needles, caps, collapsed edges, equal and collinear points, folds",
                    degenerate_models),
          family_of("valences", "around vertices of valence 2 to 1000", valence_models),
          family_of("sharpnesses", "around creases and darts of sharpness 0.1 to infinity", sharpness_models)};
}

}  // namespace shaolin::stress
