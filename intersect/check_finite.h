#pragma once
/// Points that refinement led out of all numbers.
#include <algorithm>

#include "../schemes/errors.h"
#include "../schemes/vec3.h"

namespace shaolin {

/// Throws InputError if a point is not finite.
template <class Points>
void check_finite(const Points& points) {
  if (!std::all_of(points.begin(), points.end(), [](const Vec3& point) { return point.allFinite(); }))
    throw InputError(
        "refinement leads to points that are not finite: coordinates are too large, or the masks of the scheme do not "
        "converge; see 'shaolin scheme check'");
}

}  // namespace shaolin
