#pragma once
/// Hits and misses held against the oracle and the dense check.
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "intersect/scene.h"
#include "tools/validate/agreement.h"
#include "tools/validate/dense_check.h"
#include "tools/validate/sampling.h"

namespace shaolin {

/// The party that is checked; Scene's functions. Both are called from several threads at once.
struct Intersector {
  std::function<std::optional<Hit>(const Ray&)> intersect;
  std::function<bool(const Ray&)> occluded;

  static Intersector of(const Scene& scene);
};

/// What came of the rays of one kind.
struct RayFigures {
  std::size_t rays = 0, hits = 0;
  std::size_t lost = 0;            ///< a certain hit of the oracle's surface is nearer, or there is no hit
  std::size_t ghosts = 0;          ///< the hit is not on the ray, not on the oracle's surface, or out of the interval
  std::size_t wrong_normals = 0;   ///< at a right position
  std::size_t wrong_occluded = 0;  ///< occluded() and intersect() differ
  std::size_t undecided = 0;       ///< a lost hit that is no matter of rounding could not be told from one that is
  std::size_t seen = 0;            ///< hits that the dense check sees, too: how far its silence can be trusted
  std::size_t undetermined_normals = 0;
  std::size_t uncertified = 0;  ///< hits, see certificate.h
  double worst_on_ray = 0;      ///< of |t| |d| + diagonal
  double worst_on_surface = 0;  ///< in diagonals
  double worst_normal = 0;      ///< rad, where determined

  void add(const RayFigures& other);
  bool passed() const { return lost + ghosts + wrong_normals + wrong_occluded == 0; }
};

struct RayReport {
  std::array<RayFigures, ray_kinds.size()> by_kind;  ///< in the order of ray_kinds
  std::vector<Disagreement> disagreements;

  RayFigures total() const;
  bool passed() const { return disagreements.empty(); }
};

/// Traces all rays in parallel, then checks them one after the other. A ray's missing hit counts as lost if the hit is
/// certain: the eight rays moved sideways by 1e-10 diagonals hit the surface there, too. Then neither rounding nor the
/// dense check's own tolerance of 1e-11 can have made it. What is less certain (at silhouettes and boundaries) counts
/// as undecided. Without a dense check (null) hits are missed only where rays were aimed, and a hit is certain if the
/// ray crosses the surface there by construction.
RayReport check_rays(const Intersector& ours, const Oracle& oracle, const DenseCheck* dense,
                     std::span<const ProbeRay> rays);

}  // namespace shaolin
