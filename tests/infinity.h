#pragma once
// One name for it in all tests, which are compiled together.
#include <limits>

namespace shaolin {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace shaolin
