#include "tools/bench/embree_scene.h"

#include <stdexcept>

#include "tools/bench/embree_subdivision.h"
#include "tools/bench/tessellation.h"

namespace shaolin {

EmbreeScene::EmbreeScene(const ControlMesh& mesh, const std::string& scheme, int level)
    : device_(rtcNewDevice("threads=1")) {
  if (!device_) throw std::runtime_error("Embree does not start");
  scene_.reset(rtcNewScene(device_.get()));
  const EmbreeGeometry geometry = scheme == "loop" ? embree_geometry(device_.get(), tessellate_loop(mesh, level))
                                                   : embree_subdivision(device_.get(), mesh, level);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build this scene");
}

std::optional<EmbreeScene::Hit> EmbreeScene::intersect(const Ray& ray) const {
  const RTCRayHit found = embree_intersect(scene_.get(), ray);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{found.ray.tfar, Vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z).normalized()};
}

bool EmbreeScene::occluded(const Ray& ray) const { return embree_occluded(scene_.get(), ray); }

}  // namespace shaolin
