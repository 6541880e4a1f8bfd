#pragma once
/// Where surfaces and shapes have a point in common.
#include <compare>

#include "../schemes/limit_sample.h"

namespace shaolin {

/// A point of a surface that a shape holds, to rounding, in the world's space.
struct ShapeContact {
  SurfaceParameter at;  ///< face, sub, u, v in the input's terms
  LimitSample sample;   ///< the limit position, the unit normal, derivatives
  Vec3 on_shape;        ///< the shape's point that is nearest to the position: equal to it, up to rounding
  int level = 0;        ///< the refinement level of the piece that it was found in
  int instance = 0;     ///< the index of the instance in its scene
};

/// A point that two surfaces have in common, as a place of either; `on_shape` is the other's position.
struct SurfaceContact {
  ShapeContact own, other;
};

/// A face of an instance, by its index in the input.
struct PickedFace {
  int instance = 0;
  int face = 0;

  auto operator<=>(const PickedFace&) const = default;
};

/// Where a moving sphere first touches a surface, in the world's space.
struct SweepContact {
  double t = 0;         ///< in units of the displacement, in [0, 1]; 0 where the sphere meets the surface at its start
  SurfaceParameter at;  ///< face, sub, u, v in the input's terms
  LimitSample sample;   ///< the limit position, the unit normal, derivatives
  Vec3 centre;          ///< of the sphere at that time
  Vec3 normal;          ///< unit, from the position to the centre; the surface's normal where the two are one point,
                        ///< up to rounding
  int level = 0;
  int instance = 0;
};

}  // namespace shaolin
