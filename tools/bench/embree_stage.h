#pragma once
/// The peer on whole scenes: Embree 3, by the triangles of Uniform or by its own subdivision geometry.
#include <atomic>
#include <cstddef>

#include "tools/bench/embree_parts.h"
#include "tools/cli/stage.h"

namespace shaolin {

enum class EmbreeSurface {
  triangles,   ///< of intersect/tessellation.h in single precision, with their corners' limit normals
  subdivision  ///< see embree_subdivision(); Catmull-Clark alone
};

/// Each object is tessellated once, at once, and shared by its instances (Uniform waits for a ray to come near). One
/// thread builds.
class EmbreeStage {
 public:
  struct Hit {
    double t;
    Vec3 normal;  ///< unit; interpolated from the limit normals, of subdivision the facet's
  };

  /// Throws what tessellate() and embree_subdivision() throw, InputError for subdivision by another scheme than
  /// catmark, std::runtime_error if Embree fails.
  EmbreeStage(const Stage& stage, int level, EmbreeSurface surface = EmbreeSurface::triangles,
              RTCSceneFlags flags = RTC_SCENE_FLAG_NONE);

  std::optional<Hit> intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const { return embree_occluded(scene_.get(), ray); }

  /// What Embree holds, and the normals.
  std::size_t bytes() const;

  /// Of the constructor's time: making the triangles, from meshes to points, corners and normals as Embree takes them.
  double tessellation_seconds() const { return tessellation_seconds_; }

 private:
  using Normals = std::vector<std::array<Eigen::Vector3f, 3>>;  ///< of a triangle's corners

  struct Part {
    EmbreeHandle<RTCSceneTy> scene;
    Normals normals{};  ///< by triangle; empty for subdivision
  };
  struct Place {
    std::size_t part;
    Eigen::Matrix3d normals;  ///< from the object's space to the world's
  };

  Part make_triangles(const LoadedModel& model, int level);
  Part make_subdivision(const LoadedModel& model, int level) const;
  EmbreeHandle<RTCSceneTy> new_scene() const;
  EmbreeHandle<RTCSceneTy> scene_of(const EmbreeGeometry& geometry) const;

  std::unique_ptr<std::atomic<std::ptrdiff_t>> bytes_;  ///< of Embree; it outlives the device, which counts with it
  EmbreeDevice device_;
  RTCSceneFlags flags_;
  std::vector<Part> parts_;
  std::vector<Place> places_;  ///< by instance
  EmbreeHandle<RTCSceneTy> scene_;
  double tessellation_seconds_ = 0;
};

}  // namespace shaolin
