#pragma once
// What a corner's patch becomes by splitting.
#include "schemes/subdivision_mesh.h"
#include "tests/catch.h"

namespace shaolin {

/// The patch at corner 0 of face 0, split towards that corner until its configuration repeats itself.
template <Scheme S>
Patch<S> stationary(const SubdivisionMesh<S>& mesh) {
  Patch<S> patch = mesh.patch({0, 0});
  for (int level = 0; level < 20 && patch.child(0).configuration != patch.configuration; ++level)
    patch = patch.child(0);
  REQUIRE(patch.child(0).configuration == patch.configuration);
  return patch;
}

}  // namespace shaolin
