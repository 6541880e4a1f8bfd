#pragma once
/// A point of the limit surface and what is known there.
#include <optional>

#include "vec3.h"

namespace shaolin {

/// A place on the limit surface. `face` counts as in the input; `sub` is the corner of a face that is not the
/// scheme's own kind (an n-gon for Catmull-Clark), else 0. u, v in [0, 1] (u + v <= 1 on triangles), the origin at
/// the face's first corner (at corner `sub` of an n-gon), u along the outgoing edge, v along the incoming edge.
struct SurfaceParameter {
  int face = 0;
  int sub = 0;
  double u = 0;
  double v = 0;
};

/// First and second parametric derivatives, per unit of u and v.
struct Derivatives {
  Vec3 du, dv, duu, duv, dvv;
};

/// Limit position, unit limit normal (along du x dv; zero where the surface has none, as where it is a segment or a
/// point), and the derivatives where they exist: at an irregular vertex they vanish or diverge, there the limit masks
/// give the normal and `derivatives` is empty.
struct LimitSample {
  Vec3 position;
  Vec3 normal;
  std::optional<Derivatives> derivatives;
};

}  // namespace shaolin
