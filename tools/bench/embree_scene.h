#pragma once
/// The peer that we race: Embree 3, single-threaded.
#include <optional>
#include <string>

#include "intersect/ray.h"
#include "schemes/control_mesh.h"
#include "tools/bench/embree_parts.h"

namespace shaolin {

class EmbreeScene {
 public:
  struct Hit {
    double t;
    Vec3 normal;  ///< the geometric normal, unit
  };

  /// For "catmark": Embree's own subdivision geometry with 2^level segments along each edge and the mesh's creases,
  /// corners and boundary mode. For "loop", which Embree does not have: triangles, see tessellate_loop(). Throws
  /// InputError for tags that Embree's geometry does not know or takes otherwise (Chaikin creases, smooth triangles,
  /// holes), std::runtime_error if Embree fails. Some semi-sharp vertices differ from OpenSubdiv's, too (edges of
  /// sharpness 5, 5 and 0.1 at one vertex do): compare the images before comparing times.
  EmbreeScene(const ControlMesh& mesh, const std::string& scheme, int level);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

 private:
  EmbreeDevice device_;
  EmbreeHandle<RTCSceneTy> scene_;
};

}  // namespace shaolin
