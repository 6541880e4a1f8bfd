#pragma once
// Models and maps that queries with shapes are tested on.
#include "tests/intersect/random_affine.h"
#include "tests/models.h"

namespace shaolin {

/// Small, and between them all that a surface can have: creases sharp and semi-sharp, darts, corners, boundaries,
/// n-gons, valences two and nine, poles.
inline std::vector<Model> shape_models() {
  static const std::vector<std::string> names{"torus",
                                              "cube_creases",
                                              "dart",
                                              "ngon_body",
                                              "sail",
                                              "saddle",
                                              "tetrahedron",
                                              "catmark_xord_boundary",
                                              "catmark_chaikin0",
                                              "catmark_cubes_semisharp",
                                              "catmark_val2_interior",
                                              "loop_cubes_semisharp",
                                              "loop_saddle_edgecorner"};
  std::vector<Model> models;
  for (const Model& model : all_models())
    if (std::find(names.begin(), names.end(), model.name) != names.end()) models.push_back(model);
  models.push_back({"poles", "catmark", shaken(poles("catmark", 9), 0.2)});
  models.push_back({"pillow", "loop", pillow()});
  return models;
}

inline Eigen::Matrix3d random_axes(Random& random) {
  const double angle = random.uniform(0, 6);
  return Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix();
}

}  // namespace shaolin
