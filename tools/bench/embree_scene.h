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

  /// For "catmark": Embree's own geometry, see embree_subdivision(). For "loop", which Embree does not have: triangles,
  /// see tessellate_loop(). Throws what these throw, std::runtime_error if Embree fails.
  EmbreeScene(const ControlMesh& mesh, const std::string& scheme, int level);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

 private:
  EmbreeDevice device_;
  EmbreeHandle<RTCSceneTy> scene_;
};

}  // namespace shaolin
