#pragma once
/// Why a hit has no certificate.
#include "tools/stress/subject.h"

namespace shaolin::stress {

/// What no certificate can be expected of, and the rest.
enum class Unproven {
  boundary,  ///< within 1e-6, in parameters, of a side that has no other face: rounding decides whether the ray passes
             ///< by
  flat,      ///< the ray touches the surface, or nearly: some normal there, or two of different sides, say so
  other
};
inline constexpr std::size_t unproven_count = 3;

/// Normals count at all faces of the place and close to it, with Subject::grazing() for a bar. The hit is sound.
Unproven reason_of(const Subject& subject, const Ray& ray, const Hit& hit);

}  // namespace shaolin::stress
