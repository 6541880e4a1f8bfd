#include "tools/bench/error_figures.h"

#include <algorithm>
#include <cmath>

#include "tools/bench/silhouette_band.h"

namespace shaolin {
namespace {

enum class Verdict : char { same, lost, ghost, farther, nearer };

struct Judged {
  Verdict verdict = Verdict::same;
  bool outside = false;
};

bool is_explained(const Scene& exact, const Ray& ray, double width, const std::optional<Answer>& answer) {
  const SilhouetteBand band = silhouette_band(exact, ray, width);
  if (!answer) return band.explains({}, width) || leads_past(exact, ray, width);
  const double distance = answer->t * ray.direction.norm();
  return band.explains(distance, width) ||
         (is_near(exact, ray.origin + answer->t * ray.direction, answer->normal, width) &&
          (band.lets_through(distance, width) || leads_past(exact, ray, width, distance)));
}

Judged judge(const Contender& contender, const Scene& exact, const Ray& ray, const std::optional<Answer>& expected,
             const std::optional<Answer>& answer) {
  if (!expected && !answer) return {};
  const double length = ray.direction.norm();
  const double width = band_width(contender.chord, ray.footprint, (expected ? expected->t : answer->t) * length);
  Judged judged;
  if (!answer) {
    judged.verdict = Verdict::lost;
  } else if (!expected) {
    judged.verdict = Verdict::ghost;
  } else {
    const double difference = (answer->t - expected->t) * length;
    if (!contender.is_adaptive() || std::abs(difference) <= width) return {};
    judged.verdict = difference > 0 ? Verdict::farther : Verdict::nearer;
  }
  if (contender.is_adaptive()) judged.outside = !is_explained(exact, ray, width, answer);
  return judged;
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

Quantiles quantiles(std::vector<double>& values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return {at(0.5), at(0.99), values.back()};
}

void ErrorFigures::add_counts(const ErrorFigures& other) {
  rays += other.rays;
  hits += other.hits;
  lost += other.lost;
  ghosts += other.ghosts;
  farther += other.farther;
  nearer += other.nearer;
  lost_outside += other.lost_outside;
  ghosts_outside += other.ghosts_outside;
  for (const Ray& ray : other.outside)
    if (outside.size() < most_listed) outside.push_back(ray);
}

HitFigures compare(const Occlusions& expected, const Occlusions& answers) {
  HitFigures figures{.rays = expected.size()};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    figures.hits += expected[i] != 0;
    figures.lost += expected[i] > answers[i];
    figures.ghosts += expected[i] < answers[i];
  }
  return figures;
}

ErrorFigures compare(const Contender& contender, const Scene& exact, std::span<const Ray> rays,
                     std::span<const std::optional<Answer>> expected, std::span<const std::optional<Answer>> answers) {
  std::vector<Judged> judged(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 256), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      judged[i] = judge(contender, exact, rays[i], expected[i], answers[i]);
  });

  ErrorFigures figures;
  figures.rays = rays.size();
  std::vector<double> distances, angles;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Judged& one = judged[i];
    const bool is_lost = one.verdict == Verdict::lost || one.verdict == Verdict::farther;
    figures.hits += expected[i].has_value();
    figures.lost += one.verdict == Verdict::lost;
    figures.ghosts += one.verdict == Verdict::ghost;
    figures.farther += one.verdict == Verdict::farther;
    figures.nearer += one.verdict == Verdict::nearer;
    if (one.outside) {
      ++(is_lost ? figures.lost_outside : figures.ghosts_outside);
      if (figures.outside.size() < ErrorFigures::most_listed) figures.outside.push_back(rays[i]);
    }
    if (!expected[i] || !answers[i]) continue;
    distances.push_back(std::abs(answers[i]->t - expected[i]->t) * rays[i].direction.norm());
    angles.push_back(angle_between(answers[i]->normal, expected[i]->normal));
  }
  figures.distance = quantiles(distances);
  figures.normal = quantiles(angles);
  return figures;
}

}  // namespace shaolin
