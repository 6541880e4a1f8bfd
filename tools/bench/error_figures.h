#pragma once
/// How far a method's answers are from the exact ones.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstddef>
#include <span>
#include <vector>

#include "tools/bench/contender.h"

namespace shaolin {

using Answers = std::vector<std::optional<Answer>>;

/// The answers intersect(ray) to all rays, in parallel. Throws what it throws.
template <class Intersect>
Answers trace(std::span<const Ray> rays, const Intersect& intersect) {
  Answers answers(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) answers[i] = intersect(rays[i]);
  });
  return answers;
}
inline Answers trace(std::span<const Ray> rays, const Tracer& tracer) {
  return trace(rays, [&](const Ray& ray) { return tracer.intersect(ray); });
}
inline Answers trace(std::span<const Ray> rays, const Scene& scene) {
  return trace(rays, [&](const Ray& ray) { return answer_of(scene.intersect(ray)); });
}

struct Quantiles {
  double median = 0, p99 = 0, max = 0;
};

/// Sorts the values; zeros if there are none.
Quantiles quantiles(std::vector<double>& values);

struct ErrorFigures {
  std::size_t rays = 0, hits = 0;  ///< hits of the exact method
  Quantiles distance{};            ///< along the ray between the hits, where both hit: a length of the scene's
  Quantiles normal{};              ///< angle between the normals there, rad
  std::size_t lost = 0;            ///< rays that only the exact method answers with a hit
  std::size_t ghosts = 0;          ///< rays that only this one does

  // Of chord and a3 alone, see silhouette_band.h:
  std::size_t farther = 0, nearer = 0;               ///< both hit, but more than the band's width apart
  std::size_t lost_outside = 0, ghosts_outside = 0;  ///< of lost and farther, and of ghosts and nearer
  std::vector<Ray> outside{};                        ///< the first few of those
  static constexpr std::size_t most_listed = 5;

  /// Keeps quantiles: those of two sets do not follow from the sets' own.
  void add_counts(const ErrorFigures& other);
};

/// Holds answers against the exact ones of the same rays. `exact` is asked again beside rays that chord or a3 answers
/// otherwise.
ErrorFigures compare(const Contender& contender, const Scene& exact, std::span<const Ray> rays,
                     std::span<const std::optional<Answer>> expected, std::span<const std::optional<Answer>> answers);

}  // namespace shaolin
