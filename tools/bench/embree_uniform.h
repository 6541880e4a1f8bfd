#pragma once
/// The baseline Uniform as strong as it can be made: the same triangles, traversed by Embree 3.
#include <atomic>
#include <cstddef>

#include "tools/bench/embree_parts.h"
#include "tools/cli/stage.h"

namespace shaolin {

/// The triangles of intersect/tessellation.h in single precision, with their corners' limit normals. Each object is
/// tessellated once, at once, and shared by its instances (Uniform waits for a ray to come near). One thread builds.
class EmbreeUniform {
 public:
  struct Hit {
    double t;
    Vec3 normal;  ///< interpolated from the limit normals, unit
  };

  /// Throws what tessellate() throws, std::runtime_error if Embree fails.
  EmbreeUniform(const Stage& stage, int level);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const { return embree_occluded(scene_.get(), ray); }

  /// What Embree holds, and the normals.
  std::size_t bytes() const;

 private:
  using Normals = std::vector<std::array<Eigen::Vector3f, 3>>;  ///< of a triangle's corners

  struct Part {
    EmbreeHandle<RTCSceneTy> scene;
    Normals normals;
  };
  struct Place {
    std::size_t part;
    Eigen::Matrix3d normals;  ///< from the object's space to the world's
  };

  Part make_part(const LoadedModel& model, int level) const;

  std::unique_ptr<std::atomic<std::ptrdiff_t>> bytes_;  ///< of Embree; it outlives the device, which counts with it
  EmbreeDevice device_;
  std::vector<Part> parts_;
  std::vector<Place> places_;  ///< by instance
  EmbreeHandle<RTCSceneTy> scene_;
};

}  // namespace shaolin
