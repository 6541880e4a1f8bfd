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

using Occlusions = std::vector<char>;  ///< by ray: whether it meets anything

/// The answers of.occluded(ray) to all rays, of a Tracer or a Scene, in parallel. Throws what it throws.
template <class Of>
Occlusions occlusions(std::span<const Ray> rays, const Of& of) {
  Occlusions result(rays.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) result[i] = of.occluded(rays[i]);
  });
  return result;
}
inline Occlusions occlusions_of(const Answers& answers) {
  Occlusions result;
  for (const auto& answer : answers) result.push_back(answer.has_value());
  return result;
}

struct Quantiles {
  double median = 0, p99 = 0, max = 0;
};

/// Sorts the values; zeros if there are none.
Quantiles quantiles(std::vector<double>& values);

/// How often a method hits and misses otherwise than the exact one.
struct HitFigures {
  std::size_t rays = 0, hits = 0;  ///< hits of the exact method
  std::size_t lost = 0;            ///< rays that only the exact method answers with a hit
  std::size_t ghosts = 0;          ///< rays that only this one does

  std::size_t own_hits() const { return hits - lost + ghosts; }  ///< of this method
};

struct ErrorFigures : HitFigures {
  Quantiles distance{};  ///< along the ray between the hits, where both hit: a length of the scene's
  Quantiles normal{};    ///< angle between the normals there, rad

  // Of chord and a3 alone, see silhouette_band.h:
  std::size_t farther = 0, nearer = 0;               ///< both hit, but more than the band's width apart
  std::size_t lost_outside = 0, ghosts_outside = 0;  ///< of lost and farther, and of ghosts and nearer
  std::vector<Ray> outside{};                        ///< the first few of those
  static constexpr std::size_t most_listed = 5;

  /// Keeps quantiles: those of two sets do not follow from the sets' own.
  void add_counts(const ErrorFigures& other);
};

/// Holds occlusions against the exact ones of the same rays.
HitFigures compare(const Occlusions& expected, const Occlusions& answers);

/// Holds answers against the exact ones of the same rays. `exact` is asked again beside rays that chord or a3 answers
/// otherwise.
ErrorFigures compare(const Contender& contender, const Scene& exact, std::span<const Ray> rays,
                     std::span<const std::optional<Answer>> expected, std::span<const std::optional<Answer>> answers);

}  // namespace shaolin
