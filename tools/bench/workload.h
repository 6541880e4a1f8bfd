#pragma once
/// The rays that all methods are measured by.
#include <vector>

#include "intersect/scene.h"
#include "tools/cli/camera.h"
#include "tools/cli/look.h"

namespace shaolin {

/// A picture's primary rays and, from the exact method's hits, its shadow rays: the same for every method, so that all
/// do the same work. What a mirror reflects is left out. Random and ambient rays are there if they were added.
struct Workload {
  std::vector<Ray> primary;  ///< row by row, one through each pixel's centre; directions are unit
  std::vector<Ray> shadow;   ///< to each light that a hit's side of the surface looks at; they end there, at t = 1
  std::vector<Ray> random;   ///< incoherent; their hits are asked for
  std::vector<Ray> ambient;  ///< of ambient occlusion
};

/// A shadow ray starts four pixels (at its hit) off the surface, on the side that is seen: chords are off the limit by
/// the size of patches that are not refined, two pixels, and a surface must not shade itself when the shadow ray meets
/// other chords than the primary ray. Its footprint is the pixel's at the hit, as in pictures. Without lights in `look`
/// there is the key light of pictures.
Workload make_workload(const Scene& exact, const View& view, const Look& look);

/// As many random rays as there are primary ones: from a sphere around the scene to points of its box, with pixels as
/// wide as the camera's. And for each hit of a primary ray a ray of ambient occlusion: into the hemisphere on the side
/// that is seen, by the cosine, as long as a twentieth of the scene's diagonal, off the surface as a shadow ray. Always
/// the same rays.
void add_random_and_ambient_rays(const Scene& exact, Workload& work);

}  // namespace shaolin
