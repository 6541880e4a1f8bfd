/// Models far from the origin, tiny and huge, turned, and seen from afar: by control points and by instances.
#include <cstdio>

#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

using Subjects = std::vector<std::unique_ptr<const Subject>>;

std::string with(const std::string& what, double number) {
  char text[64];
  std::snprintf(text, sizeof text, "%s %.6g", what.c_str(), number);
  return text;
}

/// The model under a map, by its control points and by a transform of an instance.
void add_both(Subjects& subjects, const StressModel& model, const QueriesOf& queries, const std::string& variant,
              const Affine& map) {
  StressModel moved = model;
  for (Vec3& point : moved.mesh.positions) point = map * point;
  subjects.push_back(std::make_unique<const Subject>(moved, queries, variant));
  subjects.push_back(std::make_unique<const Subject>(model, queries, variant + " (instance)", map));
}

Subjects translated(const StressModel& model, const QueriesOf& queries) {
  Subjects subjects;
  for (const double by : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9})
    add_both(subjects, model, queries, with("translated by", by),
             Affine(Eigen::Translation3d(by * Vec3(0.7, -1, 0.4))));
  return subjects;
}

Subjects scaled(const StressModel& model, const QueriesOf& queries) {
  Subjects subjects;
  for (const double by : {1e-12, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 1e12})
    add_both(subjects, model, queries, with("scaled by", by), Affine(Eigen::Scaling(by)));
  return subjects;
}

Subjects rotated(const StressModel& model, const QueriesOf& queries) {
  Subjects subjects;
  SampleRandom random(1);  // the same turns whatever the rays
  for (int turn = 0; turn < 4; ++turn) {
    const Vec3 axis = turn == 0 ? Vec3(0, 0, 1) : random.direction();
    const double angle = turn == 0 ? 0.25 * std::numbers::pi : random.between(0, 2 * std::numbers::pi);
    add_both(subjects, model, queries, with("rotation", turn),
             Affine(Eigen::AngleAxisd(angle, axis).toRotationMatrix()));
  }
  return subjects;
}

/// The points of an instance round in the world's space, its rays meet it in its own: by an ulp of its shift a ray may
/// miss an outline or a boundary, or pass a corner on another side than the edge it is aimed at. There only rays that
/// cross the surface, inside of faces or of closed surfaces and not close to the end of an edge, cannot miss.
Probe with_certain_target(const Subject& subject, const Aim& aim, Probe probe) {
  constexpr double steep = 1e-2, shared = 0.1;
  const Probe::Target& target = *probe.target;
  const auto is_near_end = [](double x) { return (x > 0 && x < 1e-3) || (x < 1 && x > 1 - 1e-3); };
  const bool is_near_corner = is_near_end(aim.at.u) || is_near_end(aim.at.v);
  const bool is_inside = !aim.is_shared || (subject.is_closed() && !is_near_corner);
  // Far from the origin errors are large against pieces at irregular vertices, and contacts without number.
  probe.closest_only |= aim.is_shared && target.cosine < shared;
  if (subject.is_moved_instance() && !(target.is_crossed && target.cosine > steep && is_inside)) probe.target.reset();
  return probe;
}

Probe near_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_anywhere(subject, random);
  return with_certain_target(subject, aim, probe_at(subject, aim, direction_at(subject, aim, random), random));
}

Probe far_probe(const Subject& subject, SampleRandom& random) {
  const Aim aim = aim_anywhere(subject, random);
  const Vec3 direction = direction_at(subject, aim, random);
  return with_certain_target(subject, aim, probe_at(subject, aim, direction, 1e6 * subject.diagonal(), random));
}

template <class Make>
Family moved(const std::string& name, const std::string& meaning, Make make) {
  const auto stage = [=](const StressModel& model, const QueriesOf& queries) {
    return probe_stage(name, make(model, queries), near_probe);
  };
  return {name, meaning, stage};
}

}  // namespace

std::vector<Family> moved_families() {
  const auto far = [](const StressModel& model, const QueriesOf& queries) {
    Subjects subjects;
    subjects.push_back(std::make_unique<const Subject>(model, queries));
    subjects.push_back(std::make_unique<const Subject>(model, queries, "an instance, turned by 1 rad",
                                                       Affine(Eigen::AngleAxisd(1, Vec3::UnitZ()).toRotationMatrix())));
    return probe_stage("far origins", std::move(subjects), far_probe);
  };
  return {moved("translated", "the model 1e3 to 1e9 away, its control points and as an instance", translated),
          moved("scaled", "the model 1e-12 to 1e12 times as large, its control points and as an instance", scaled),
          moved("rotated", "the model turned, its control points and as an instance", rotated),
          {"far origins", "from 1e6 diagonals away", far}};
}

}  // namespace shaolin::stress
