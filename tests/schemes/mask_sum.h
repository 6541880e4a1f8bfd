#pragma once
// What a mask's weights add up to.
#include "schemes/scheme.h"

namespace shaolin {

inline double sum(const RingMask& mask) {
  double total = mask.vertex;
  for (const double w : mask.edges) total += w;
  for (const double w : mask.diagonals) total += w;
  return total;
}

}  // namespace shaolin
