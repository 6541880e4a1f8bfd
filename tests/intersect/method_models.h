#pragma once
// Models that the approximating methods are tested on.
#include "tests/models.h"

namespace shaolin {

/// Closed and open meshes with creases, high and low valence, n-gons.
inline std::vector<Model> method_models() {
  ControlMesh creased = with_edges(shaken(torus("catmark", 4, 6), 0.1), {{0, 1, 2.5f}, {1, 2, 10}, {2, 3, 0.5f}});
  ControlMesh holed = sheet("loop", 4, 3);
  holed.holes = {3, 7};
  return {{"poles", "catmark", shaken(poles("catmark", 5), 0.1)},
          {"poles", "loop", shaken(poles("loop", 7), 0.1)},
          {"prism", "catmark", shaken(prism(5), 0.1)},
          {"creased torus", "catmark", std::move(creased)},
          {"holed sheet", "loop", shaken(std::move(holed), 0.1)}};
}

}  // namespace shaolin
