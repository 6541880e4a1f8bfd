/// Meshes that no modeller makes on purpose, and every sharpness and valence.
#include "tools/stress/family.h"
#include "tools/stress/meshes.h"

namespace shaolin::stress {

namespace {

/// A line through the box.
Probe line(const Subject& subject, SampleRandom& random) {
  const Box& box = subject.box();
  const Vec3 origin = box.centre() + 2 * subject.diagonal() * random.direction();
  const Vec3 way = random.inside(box.lower, box.upper) - origin;
  return {{origin, way.stableNorm() > 0 ? way : random.direction()}};
}

/// Two in three are aimed, the others lines.
Probe aimed_or_line(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_anywhere(subject, random);
  return random.one_in(3) ? line(subject, random) : probe_at(subject, aim, direction_at(subject, aim, random), random);
}

/// The same. Where a surface is a curve or a point all rays that meet it are tangent to it, and where it turns over
/// itself winding is a matter of rounding: only the closest hit is asked for.
Probe closest_only(const Subject& subject, SampleRandom& random) {
  Probe probe = aimed_or_line(subject, random);
  probe.closest_only = true;
  return probe;
}

/// Of lines, all hits; of what is aimed at the many patches of a vertex, the closest.
Probe at_valence(const Subject& subject, SampleRandom& random) {
  return random.one_in(3) ? line(subject, random) : closest_only(subject, random);
}

Family family_of(const std::string& name, const std::string& meaning, std::vector<StressModel> (*models)(),
                 Probe (*draw)(const Subject&, SampleRandom&)) {
  const auto stage = [=](const StressModel& model, const QueriesOf& queries) {
    return probe_stage(name, std::make_unique<const Subject>(model, queries), draw);
  };
  return {name, meaning, stage, models};
}

}  // namespace

std::vector<Family> degenerate_families() {
  return {family_of("degenerate", "slivers, needles, caps, collapsed edges, equal and collinear points, folds",
                    degenerate_models, closest_only),
          family_of("valences", "around vertices of valence 2 to 1000", valence_models, at_valence),
          family_of("sharpnesses", "around creases and darts of sharpness 0.1 to infinity", sharpness_models,
                    aimed_or_line)};
}

}  // namespace shaolin::stress
