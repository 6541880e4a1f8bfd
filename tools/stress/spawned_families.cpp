/// Rays that start at hits: none may meet its own origin, none may leak.
#include <cmath>

#include "tools/stress/family.h"

namespace shaolin::stress {

namespace {

/// A ray from one crossing of a line, on the side where the line goes on or came from. It starts at the hit itself; its
/// tmin passes the surface by what rounding can be: the hit is off by at most 12 of the bound (check.cpp), the spawned
/// ray counts points as on it that are within 2 more of its own, and on a slope of cosine c that is as much over c
/// along it. 16 / c bounds (12 + 2) / c and leaves room for the curvature, on surfaces that bend less than 1e-2 rad
/// within 1e-12 diagonals.
class SpawnStage final : public Stage {
 public:
  explicit SpawnStage(std::unique_ptr<const Subject> subject) : subject_(std::move(subject)) {}

  void shoot(SampleRandom& random, Tally& tally) const override {
    const Box& box = subject_->box();
    const Vec3 from = box.centre() + random.between(0.6, 3) * subject_->diagonal() * random.direction();
    const Vec3 to = random.one_in(2) ? aim_anywhere(*subject_, random).position : random.inside(box.lower, box.upper);
    const Ray line{from, (to - from).normalized(), -infinity, infinity};
    Check check(*subject_, "spawned", tally);
    check.ray({line});
    const std::vector<Crossing> all = subject_->queries().all_hits(line);
    if (all.empty()) return;
    const std::size_t k = random.index(all.size());
    if (all[k].sense == Sense::touches || std::abs(all[k].hit.sample.normal.dot(line.direction)) < steep) return;
    spawn(line, all, k, random, check, tally);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double steep = 0.05;  ///< the least cosine of rays against the surface that they start from

  void spawn(const Ray& line, const std::vector<Crossing>& all, std::size_t k, SampleRandom& random, Check& check,
             Tally& tally) const {
    const Hit& hit = all[k].hit;
    Ray ray{hit.sample.position, random.direction()};
    const double cosine = hit.sample.normal.dot(ray.direction);
    if (std::abs(cosine) < steep) return;
    ray.tmin = 16 * std::max(subject_->rounding(line), subject_->rounding(ray)) / std::abs(cosine);
    if (const std::optional<Hit> own = subject_->queries().intersect(ray)) {
      ++tally.hits;
      const bool is_own = own->at.face == hit.at.face && own->t <= 4 * ray.tmin;
      if (is_own) return check.fail(Fault::ghost, ray, "a ray from a hit meets its own origin: " + text(*own));
    }
    if (!subject_->is_closed() || !is_smooth(hit)) return;
    // On the side where the line goes on the surface winds as the crossings behind this one say; on the other as it
    // does with this one.
    const bool goes_on = cosine * hit.sample.normal.dot(line.direction) > 0;
    const int expected = Check::winding(std::span(all).subspan(goes_on ? k + 1 : k));
    const int winding = check.winding(ray);
    if (winding != expected)
      check.fail(
          Fault::lost, ray,
          "leaks: its winding number is " + std::to_string(winding) + ", where it starts " + std::to_string(expected));
  }

  /// Inside of a face: beside an edge that is sharp the ray may start on the other side of the next face.
  bool is_smooth(const Hit& hit) const {
    const double side = subject_->surface().triangular() ? 1 - hit.at.u - hit.at.v : 1 - std::max(hit.at.u, hit.at.v);
    return std::min({hit.at.u, hit.at.v, side}) > 1e-6;
  }

  std::unique_ptr<const Subject> subject_;
};

}  // namespace

std::vector<Family> spawned_families() {
  const auto stage = [](const StressModel& model, const QueriesOf& queries) -> std::unique_ptr<const Stage> {
    auto subject = std::make_unique<const Subject>(model, queries);
    if (subject->sites().pieces.empty()) return nullptr;
    return std::make_unique<SpawnStage>(std::move(subject));
  };
  return {{"spawned", "from hits: none meets its own origin, none leaks", stage}};
}

}  // namespace shaolin::stress
