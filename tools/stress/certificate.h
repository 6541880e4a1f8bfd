#pragma once
/// Whether a hit is proven: the one place that reads it.
#include <optional>

#include "intersect/ray.h"

namespace shaolin::stress {

/// True if the hit carries a proof that it is there and within its error bound, false if it says that it carries none;
/// empty, as always today, if hits do not say.
inline std::optional<bool> is_certified(const Hit&) { return {}; }

}  // namespace shaolin::stress
