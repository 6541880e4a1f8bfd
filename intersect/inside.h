#pragma once
/// Inside and outside of closed surfaces.
#include "object.h"

namespace shaolin {

/// Throws InputError unless the surface is closed: every side of a face is one of exactly one other, the other way
/// round, there are no holes, and every face has a limit surface. O(n log n).
void expect_closed(const LimitSurface& surface);

/// True if a closed surface winds around the point: if along a ray from there its crossings, leaving counted 1 and
/// entering -1, do not sum to 0. Which way its normals point does not matter. A point within rounding of the surface
/// may be on either side. A ray that touches the surface is given up for another; of eight that touch the last counts.
bool is_inside(const Object& object, const Vec3& point, RayCounters& counters);

}  // namespace shaolin
