#include "tools/validate/check_rays.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shaolin {
namespace {

/// In diagonals. Two hits this close along a ray are the same one: the hits of rays that cross the surface at 1e-4 rad,
/// a rounding of 1e-14 apart, are 1e-10 apart.
constexpr double same_hit = 1e-9;
/// How far a ray is moved sideways to see whether its hit is certain, and how far along the ray the hit may move then:
/// at 1e-4 rad it is 1e4 times as far.
constexpr double most_sideways = 1e-10;
constexpr double most_along = 1e-5;

struct ProbeAnswer {
  std::optional<Hit> hit;
  char occluded = false;
};

std::vector<ProbeAnswer> trace(const Intersector& ours, std::span<const ProbeRay> rays) {
  std::vector<ProbeAnswer> answers(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    answers[i] = {ours.intersect(rays[i].ray), static_cast<char>(ours.occluded(rays[i].ray))};
  });
  return answers;
}

/// A maximum that a NaN does not slip through.
void raise(double& worst, double error) {
  if (!(error <= worst)) worst = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

std::string text(const Hit& hit) {
  return "t " + exact(hit.t) + " at " + exact(hit.at) + " position " + exact(hit.sample.position) + " normal " +
         exact(hit.sample.normal);
}

class RayCheck {
 public:
  RayCheck(const Oracle& oracle, const DenseCheck* dense) : oracle_(oracle), dense_(dense) {}

  void ray(const ProbeRay& probe, const ProbeAnswer& answer);
  const RayReport& report() const { return report_; }

 private:
  /// A ray with the lengths that its direction's unit makes of fractions of the diagonal.
  struct Context {
    const Ray& ray;
    RayFigures& figures;
    double speed;  ///< |direction|

    double step(double diagonals, double diagonal) const { return diagonals * diagonal / speed; }
  };

  void hit(const Context& context, const Hit& hit);
  void normal(const Context& context, const Hit& hit, const LimitSample& expected);
  void nearer(const Context& context, const std::optional<Hit>& hit, const ProbeRay& probe);
  std::optional<OracleHit> closest(const Ray& ray, double tmin, double tmax) const {
    return dense_ ? dense_->closest(ray.origin, ray.direction, tmin, tmax) : std::nullopt;
  }
  bool certain(const Ray& ray, double t) const;
  void disagree(const char* what, const Ray& ray, std::string detail, double error, double allowed) {
    report_.disagreements.push_back({what, {}, ray, std::move(detail), error, allowed});
  }

  const Oracle& oracle_;
  const DenseCheck* dense_;
  RayReport report_;
};

void RayCheck::ray(const ProbeRay& probe, const ProbeAnswer& answer) {
  RayFigures& figures = report_.by_kind[static_cast<std::size_t>(probe.kind)];
  const Context context{probe.ray, figures, probe.ray.direction.norm()};
  ++figures.rays;
  figures.hits += answer.hit.has_value();
  if (static_cast<bool>(answer.occluded) != answer.hit.has_value()) {
    ++figures.wrong_occluded;
    disagree("occluded", probe.ray,
             answer.hit ? "false, intersect has " + text(*answer.hit) : "true, intersect has no hit", 1, 0);
  }
  if (answer.hit) hit(context, *answer.hit);
  nearer(context, answer.hit, probe);
}

/// The reported place, by the oracle, must be on the ray where the hit says.
void RayCheck::hit(const Context& context, const Hit& hit) {
  const Ray& ray = context.ray;
  const std::optional<LimitSample> expected = oracle_.evaluate(hit.at);
  const double reach = std::abs(hit.t) * context.speed + oracle_.diagonal();
  const double on_ray = (ray.origin + hit.t * ray.direction - hit.sample.position).norm() / reach;
  const double on_surface = expected ? (expected->position - hit.sample.position).norm() / oracle_.diagonal()
                                     : std::numeric_limits<double>::infinity();
  raise(context.figures.worst_on_ray, on_ray);
  raise(context.figures.worst_on_surface, on_surface);
  const bool in_interval = hit.t >= ray.tmin && hit.t <= ray.tmax;
  if (!(on_ray <= bar::on_ray) || !(on_surface <= bar::on_surface) || !in_interval) {
    ++context.figures.ghosts;
    const bool off_surface = !(on_surface <= bar::on_surface);
    disagree(off_surface   ? "ghost hit: off the surface"
             : in_interval ? "ghost hit: off the ray"
                           : "ghost hit: interval",
             ray, text(hit) + (expected ? ", oracle position " + exact(expected->position) : ", oracle has no surface"),
             off_surface ? on_surface : on_ray, off_surface ? bar::on_surface : bar::on_ray);
    return;
  }
  context.figures.uncertified += !hit.certificate.is_certified();
  normal(context, hit, *expected);
  const double window = context.step(most_along, oracle_.diagonal());
  context.figures.seen += closest(ray, hit.t - window, hit.t + window).has_value();
}

void RayCheck::normal(const Context& context, const Hit& hit, const LimitSample& expected) {
  if (!has_determined_normal(expected)) {
    ++context.figures.undetermined_normals;
    return;
  }
  const double error = angle_between_units(hit.sample.normal, expected.normal);
  raise(context.figures.worst_normal, error);
  if (error <= bar::normal) return;
  ++context.figures.wrong_normals;
  disagree("normal of a hit", context.ray, text(hit) + ", oracle normal " + exact(expected.normal), error, bar::normal);
}

/// Looks for a hit before ours, or for any where we have none.
void RayCheck::nearer(const Context& context, const std::optional<Hit>& hit, const ProbeRay& probe) {
  const Ray& ray = context.ray;
  const double slack = context.step(same_hit, oracle_.diagonal());
  const double end = hit ? hit->t - slack : ray.tmax;
  std::optional<double> nearer;
  if (const auto seen = closest(ray, ray.tmin, end)) nearer = seen->t;
  if (probe.target && *probe.target < end && (!nearer || *probe.target < *nearer)) nearer = probe.target;
  if (!nearer) return;
  // At an end of the interval, rounding decides.
  const bool inside = *nearer >= ray.tmin + slack && *nearer <= ray.tmax - slack;
  if (!inside || !(dense_ ? certain(ray, *nearer) : probe.crosses_at_target)) {
    ++context.figures.undecided;
    return;
  }
  ++context.figures.lost;
  disagree(hit ? "lost hit: a farther one reported" : "lost hit", ray,
           (hit ? "ours " + text(*hit) : std::string("ours none")) + ", oracle t " + exact(*nearer), 1, 0);
}

bool RayCheck::certain(const Ray& ray, double t) const {
  const double window = most_along * oracle_.diagonal() / ray.direction.norm();
  const Vec3 side = ray.direction.unitOrthogonal(), other = ray.direction.cross(side).normalized();
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4;
    const Vec3 moved =
        ray.origin + most_sideways * oracle_.diagonal() * (std::cos(angle) * side + std::sin(angle) * other);
    if (!closest({moved, ray.direction}, t - window, t + window)) return false;
  }
  return true;
}

}  // namespace

void RayFigures::add(const RayFigures& other) {
  rays += other.rays;
  hits += other.hits;
  lost += other.lost;
  ghosts += other.ghosts;
  wrong_normals += other.wrong_normals;
  wrong_occluded += other.wrong_occluded;
  undecided += other.undecided;
  seen += other.seen;
  undetermined_normals += other.undetermined_normals;
  uncertified += other.uncertified;
  worst_on_ray = std::max(worst_on_ray, other.worst_on_ray);
  worst_on_surface = std::max(worst_on_surface, other.worst_on_surface);
  worst_normal = std::max(worst_normal, other.worst_normal);
}

RayFigures RayReport::total() const {
  RayFigures sum;
  for (const RayFigures& figures : by_kind) sum.add(figures);
  return sum;
}

Intersector Intersector::of(const Scene& scene) {
  return {[&](const Ray& ray) { return scene.intersect(ray); }, [&](const Ray& ray) { return scene.occluded(ray); }};
}

RayReport check_rays(const Intersector& ours, const Oracle& oracle, const DenseCheck* dense,
                     std::span<const ProbeRay> rays) {
  const std::vector<ProbeAnswer> answers = trace(ours, rays);
  RayCheck check(oracle, dense);
  for (std::size_t i = 0; i < rays.size(); ++i) check.ray(rays[i], answers[i]);
  return check.report();
}

}  // namespace shaolin
