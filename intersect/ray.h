#pragma once
/// Rays and what they meet.
#include <cstdint>
#include <limits>

#include "../schemes/limit_sample.h"

namespace shaolin {

/// Points origin + t direction with tmin <= t <= tmax. The direction need not be unit: t is in units of its length.
struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double tmin = 0;
  double tmax = std::numeric_limits<double>::infinity();
};

/// The closest point of the limit surface on a ray.
struct Hit {
  double t = 0;
  SurfaceParameter at;  ///< face, sub, u, v in the input's terms
  LimitSample sample;   ///< the limit position (it lies on the ray to rounding), the unit normal, derivatives
  int level = 0;        ///< the refinement level of the patch that was met: its parameter square has side 2^-level
  int instance = 0;     ///< the index of the instance in its scene
};

/// Work done since the scene was committed; the sums over all threads.
struct Statistics {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t faces = 0;          ///< faces with a limit surface (n-gons count once per corner)
  std::uint64_t faces_touched = 0;  ///< of these, the ones that any ray made refine
  std::uint64_t patches_split = 0;  ///< patches whose four children were made
  std::uint64_t hull_tests = 0;     ///< RP/CP tests of a patch's control points
  std::uint64_t cells = 0;          ///< parameter cells that the finish looked at
  std::uint64_t newton_steps = 0;
  std::uint64_t bytes = 0;  ///< memory held by patches and their tables
};

}  // namespace shaolin
