#pragma once
/// How exact the exact method is.
#include <span>

#include "tools/bench/error_figures.h"

namespace shaolin {

/// Hits against the limit surface at their (face, sub, u, v), refined in numbers of 113 bits (quad_oracle.h); lengths
/// of the scene's.
struct ExactErrors {
  std::size_t hits = 0;
  Quantiles position;  ///< from the hit's position to the surface's point
  Quantiles across;    ///< from the surface's point to the ray
  Quantiles along;     ///< along the ray, from the hit's t to the surface's point
};

/// Of up to `count` of the rays that hit, spread evenly over all of them. Empty if a model's scheme is a plug-in's.
/// Some 20 ms a hit. Throws InputError for meshes that OpenSubdiv declines.
ExactErrors exact_errors(const Stage& stage, const Scene& exact, std::span<const Ray> rays, std::size_t count);

}  // namespace shaolin
