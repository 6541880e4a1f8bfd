#pragma once
/// The order in which many rays are traced.
#include <cstdint>
#include <span>
#include <vector>

#include "box.h"
#include "ray.h"

namespace shaolin {

/// Numbers of the rays, each once, so that rays follow each other that are likely to meet the same patches: by the
/// octant of their direction, then along a Morton curve through the places where they enter the box, in 1024 steps
/// along each axis; last those that miss it, and those whose numbers are none. Rays that come in such an order as it
/// is, as those of a picture line by line do, keep it: of a sample of neighbours seven in eight then have one octant,
/// and places less than 1/16 of the box apart, or miss. O(n log n), or O(n) for these.
std::vector<std::uint32_t> coherent_order(std::span<const Ray> rays, const Box& box);

}  // namespace shaolin
