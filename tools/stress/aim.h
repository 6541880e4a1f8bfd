#pragma once
/// Rays through points of the surface that are known beforehand, by evaluation.
#include <limits>
#include <optional>
#include <vector>

#include "tools/stress/subject.h"

namespace shaolin {
class SampleRandom;
}

namespace shaolin::stress {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point of the surface and the normals of the faces that meet there.
struct Aim {
  SurfaceParameter at;  ///< in one of the faces
  Vec3 position;
  bool is_shared = false;     ///< at a vertex or an edge
  std::vector<Vec3> normals;  ///< zero where a face has none; of at most 16 faces
  std::optional<Derivatives> derivatives = {};

  /// The least |cosine| of a unit direction against the faces: 0 if any of them has no normal.
  double cosine(const Vec3& direction) const;
  /// All faces see the ray come from the same side: then it crosses the surface there, once.
  bool is_crossed(const Vec3& direction) const;
};

/// A ray, and where it meets the surface by construction. A nearer hit may exist.
struct Probe {
  struct Target {
    double t;
    double cosine;  ///< see Aim
    bool is_crossed;
    bool is_exact = true;  ///< the surface is met there; false: there or before
  };
  Ray ray;
  std::optional<Target> target = {};
  bool closest_only = false;  ///< all hits are not asked for
};

Aim aim_at(const Subject& subject, const VertexSite& vertex, SampleRandom& random);
/// In the middle, anywhere, near an end down to 1e-9, or at a dyadic number.
Aim aim_at(const Subject& subject, const EdgeSite& edge, SampleRandom& random);
/// At a place inside of a face.
Aim aim_inside(const Subject& subject, SampleRandom& random);
/// At a vertex, an edge or inside of a face; which of the three is drawn.
Aim aim_anywhere(const Subject& subject, SampleRandom& random);

/// A unit direction: an axis, along or across a normal, from another aim, or any.
Vec3 direction_at(const Subject& subject, const Aim& aim, SampleRandom& random);

/// A ray through the aim that starts `distance` before it, a length; the direction gets a length of 2^-6 to 2^6, a
/// power of two in half of all cases. Flatter than Subject::grazing() through a vertex or an edge only the closest hit
/// is asked for: along tangents at irregular vertices all hits may take seconds (docs/robustness.md).
Probe probe_at(const Subject& subject, const Aim& aim, const Vec3& direction, double distance, SampleRandom& random);
/// From half a diagonal to three diagonals before it.
Probe probe_at(const Subject& subject, const Aim& aim, const Vec3& direction, SampleRandom& random);

/// Moves each number by one unit in the last place, up, down or not at all.
Vec3 nudged(Vec3 point, SampleRandom& random);

/// One of many, which must not be empty.
template <class T>
const T& pick(const std::vector<T>& from, SampleRandom& random);

}  // namespace shaolin::stress

#include "tools/validate/random.h"

namespace shaolin::stress {

template <class T>
const T& pick(const std::vector<T>& from, SampleRandom& random) {
  return from[random.index(from.size())];
}

}  // namespace shaolin::stress
