#pragma once
/// Rays and what they meet.
#include <limits>

#include "../schemes/limit_sample.h"
#include "certificate.h"

namespace shaolin {

/// How wide the pixel is that a ray stands for: an isotropic ray differential (a cone about the ray; Igehy 1999 keeps
/// both directions apart). Chord and a3 measure patches by it; other methods read nothing of it.
struct Footprint {
  double width = 0;   ///< at the origin, a length of the ray's space; this and growth 0: not known
  double growth = 0;  ///< of the width along the ray, per unit of length
  double unit = 1;    ///< the length, in the ray's space, of one unit of the scene's: not 1 only inside instances

  double at(double distance) const { return width + growth * distance; }
};

/// Points origin + t direction with tmin <= t <= tmax. The direction need not be unit: t is in units of its length.
struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitX();
  double tmin = 0;
  double tmax = std::numeric_limits<double>::infinity();
  Footprint footprint = {};
};

/// The closest point of the limit surface on a ray.
struct Hit {
  double t = 0;
  SurfaceParameter at;  ///< face, sub, u, v in the input's terms
  LimitSample sample;   ///< the limit position (it lies on the ray to rounding), the unit normal, derivatives
  int level = 0;        ///< the refinement level of the patch that was met: its parameter square has side 2^-level
  int instance = 0;     ///< the index of the instance in its scene
  Certificate certificate;
};

}  // namespace shaolin
