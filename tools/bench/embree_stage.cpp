#include "tools/bench/embree_stage.h"

#include "intersect/tessellation.h"
#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "tools/bench/embree_subdivision.h"
#include "tools/bench/thread_stopwatch.h"

namespace shaolin {
namespace {

/// Calls use(scheme) with the model's scheme, a plug-in's or a built-in one.
template <class Use>
auto with_scheme_of(const LoadedModel& model, Use use) {
  return model.masks ? with_masks(model.masks, use) : with_scheme(model.scheme, use);
}

bool count_bytes(void* bytes, ssize_t change, bool /*post*/) {
  *static_cast<std::atomic<std::ptrdiff_t>*>(bytes) += change;
  return true;
}

void check(RTCDevice device) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build this scene");
}

}  // namespace

EmbreeHandle<RTCSceneTy> EmbreeStage::new_scene() const {
  EmbreeHandle<RTCSceneTy> scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(), flags_);
  return scene;
}

EmbreeHandle<RTCSceneTy> EmbreeStage::scene_of(const EmbreeGeometry& geometry) const {
  EmbreeHandle<RTCSceneTy> scene = new_scene();
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  check(device_.get());
  return scene;
}

EmbreeStage::Part EmbreeStage::make_triangles(const LoadedModel& model, int level) {
  ThreadStopwatch stopwatch;
  EmbreeTriangles triangles;
  Part part;
  with_scheme_of(model, [&](const auto& scheme) {
    using S = std::decay_t<decltype(scheme)>;
    const auto tessellation = tessellate(SubdivisionMesh<S>(model.mesh, scheme), level);
    for (const Vec3& p : tessellation.points)
      triangles.points.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    for (const auto& facet : tessellation.facets)
      for (std::size_t last = 2; last < facet.corners.size(); ++last) {
        const std::array<std::size_t, 3> places{0, last - 1, last};
        std::array<std::uint32_t, 3> corners{};
        std::array<Eigen::Vector3f, 3> normals;
        for (std::size_t i = 0; i < 3; ++i) {
          corners[i] = static_cast<std::uint32_t>(facet.corners[places[i]]);
          normals[i] = facet.normals[places[i]].template cast<float>();
        }
        triangles.triangles.push_back(corners);
        part.normals.push_back(normals);
      }
  });
  tessellation_seconds_ += stopwatch.lap();
  part.scene = scene_of(embree_geometry(device_.get(), triangles));
  return part;
}

EmbreeStage::Part EmbreeStage::make_subdivision(const LoadedModel& model, int level) const {
  if (model.masks || model.scheme != "catmark") throw InputError("Embree subdivides by Catmull-Clark alone");
  return {scene_of(embree_subdivision(device_.get(), model.mesh, level))};
}

EmbreeStage::EmbreeStage(const Stage& stage, int level, EmbreeSurface surface, RTCSceneFlags flags)
    : bytes_(std::make_unique<std::atomic<std::ptrdiff_t>>(0)), device_(rtcNewDevice("threads=1")), flags_(flags) {
  if (!device_) throw std::runtime_error("Embree does not start");
  rtcSetDeviceMemoryMonitorFunction(device_.get(), count_bytes, bytes_.get());
  for (const LoadedModel& model : stage.models)
    parts_.push_back(surface == EmbreeSurface::triangles ? make_triangles(model, level)
                                                         : make_subdivision(model, level));
  scene_ = new_scene();
  for (const SceneFile::Instance& instance : stage.scene.instances) {
    EmbreeGeometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), parts_[instance.object].scene.get());
    const Eigen::Matrix<float, 3, 4> columns = instance.transform.matrix().topRows<3>().cast<float>();
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene_.get(), geometry.get(), static_cast<unsigned>(places_.size()));
    places_.push_back({instance.object, instance.transform.linear().inverse().transpose()});
  }
  rtcCommitScene(scene_.get());
  check(device_.get());
}

std::optional<EmbreeStage::Hit> EmbreeStage::intersect(const Ray& ray) const {
  const RTCRayHit found = embree_intersect(scene_.get(), ray);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Place& place = places_[found.hit.instID[0]];
  Eigen::Vector3f inside(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z);
  if (const Normals& all = parts_[place.part].normals; !all.empty()) {
    const auto& normals = all[found.hit.primID];
    inside = (1 - found.hit.u - found.hit.v) * normals[0] + found.hit.u * normals[1] + found.hit.v * normals[2];
  }
  return Hit{found.ray.tfar, (place.normals * inside.cast<double>()).normalized()};
}

std::size_t EmbreeStage::bytes() const {
  std::size_t total = static_cast<std::size_t>(bytes_->load());
  for (const Part& part : parts_) total += part.normals.size() * sizeof(part.normals[0]);
  return total;
}

}  // namespace shaolin
