#pragma once
// Polynomial patches and parameters at random.
#include "schemes/domain.h"
#include "tests/random.h"

namespace shaolin {

template <class Bezier>
Bezier random_patch(Random& random) {
  Bezier patch;
  for (Vec3& p : patch.b) p = random.point();
  return patch;
}

/// Uniform in a domain.
template <class D>
Parameter random_parameter(Random& random) {
  for (;;) {
    const Parameter p{random.uniform(), random.uniform()};
    if (D::contains(p)) return p;
  }
}

}  // namespace shaolin
