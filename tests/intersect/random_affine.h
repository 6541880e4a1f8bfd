#pragma once
// Affine maps at random, and what they make of meshes.
#include <Eigen/Geometry>

#include "intersect/affine.h"
#include "schemes/control_mesh.h"
#include "tests/random.h"

namespace shaolin {

/// A scale of the axes by up to 2^stretch, a shear, a turn and a shift.
inline Affine random_affine(Random& random, double stretch = 2) {
  Affine map = Affine::Identity();
  const double angle = random.uniform(0, 6);
  map.linear() = Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix();
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double size = std::exp2(random.uniform(-stretch, stretch));
    shear(i, i) = random.index(2) ? size : -size;
  }
  shear(0, 1) = random.uniform(-2, 2);
  shear(2, 0) = random.uniform(-2, 2);
  map.linear() *= shear;
  map.translation() = 5 * random.point();
  return map;
}

inline ControlMesh image_of(ControlMesh mesh, const Affine& map) {
  for (Vec3& p : mesh.positions) p = map * p;
  return mesh;
}

}  // namespace shaolin
