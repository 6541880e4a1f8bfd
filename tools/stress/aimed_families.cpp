/// Rays exactly through what patches share, and one unit in the last place beside it.
#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

using Draw = std::function<Probe(const Subject&, SampleRandom&)>;

/// Half of the rays go through the point as exactly as numbers allow, the others an ulp beside it.
Probe exactly_or_beside(const Subject& subject, Aim aim, SampleRandom& random) {
  const bool beside = random.one_in(2);
  if (beside) aim.position = nudged(aim.position, random);
  Probe probe = probe_at(subject, aim, direction_at(subject, aim, random), random);
  if (beside) probe.ray.origin = nudged(probe.ray.origin, random);
  return probe;
}

/// Rays at sites of one kind, if there are any.
template <class Site>
Family family_at(const std::string& name, const std::string& meaning, std::vector<Site> Sites::*sites) {
  const Draw draw = [sites](const Subject& subject, SampleRandom& random) {
    return exactly_or_beside(subject, aim_at(subject, pick(subject.sites().*sites, random), random), random);
  };
  const auto stage = [=](const StressModel& model, const QueriesOf& queries) -> std::unique_ptr<const Stage> {
    auto subject = std::make_unique<const Subject>(model, queries);
    return (subject->sites().*sites).empty() ? nullptr : probe_stage(name, std::move(subject), draw);
  };
  return {name, meaning, stage};
}

}  // namespace

std::vector<Family> aimed_families() {
  return {family_at("vertices", "through limit points of vertices", &Sites::vertices),
          family_at("edges", "through points of edges", &Sites::edges),
          family_at("creases", "through points of creases and boundaries", &Sites::creases),
          family_at("extraordinary", "through extraordinary points, corners, ends of creases, middles of n-gons",
                    &Sites::extraordinary)};
}

}  // namespace shaolin::stress
