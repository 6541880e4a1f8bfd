#pragma once
/// What gives a scene its colours: materials, lights, background.
#include <optional>
#include <vector>

#include "schemes/vec3.h"

namespace shaolin {

/// Colours are linear, Rec. 709 primaries.
struct Material {
  Vec3 color{0.62, 0.56, 0.50};  ///< the share of light that is scattered
  double mirror = 0;             ///< the share of the picture that is a reflection; the rest is the colour's
};

/// Shines from one point, equally far and near.
struct PointLight {
  Vec3 position, color;
};

struct Look {
  std::vector<Material> materials{Material{}};  ///< the first is of whatever has none of its own
  std::vector<std::size_t> of_instance;         ///< an index into materials each; may be empty
  std::vector<PointLight> lights;               ///< empty: a key light beside the camera
  std::optional<Vec3> background;               ///< empty: none

  const Material& material(int instance) const {
    const auto i = static_cast<std::size_t>(instance);
    return i < of_instance.size() ? materials[of_instance[i]] : materials.front();
  }
};

}  // namespace shaolin
