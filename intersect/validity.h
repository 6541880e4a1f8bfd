#pragma once
/// How often patches of a surface may overlap themselves in their projection (section 8.1 of the paper).
#include "valid_parts.h"

namespace shaolin {

class LimitSurface;

/// The counts over all patches of a surface that the library made (see make_limit_surface()). O(patches); a coarse
/// model's take microseconds to milliseconds each.
ValidityCounts count_valid_parts(const LimitSurface& surface);

}  // namespace shaolin
