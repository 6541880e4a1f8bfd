#pragma once
/// What our uses of Embree 3 share: handles, buffers, triangles, rays.
#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "intersect/ray.h"

namespace shaolin {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
template <class T>
using EmbreeHandle = std::unique_ptr<T, ReleaseEmbree>;
using EmbreeDevice = EmbreeHandle<RTCDeviceTy>;
using EmbreeGeometry = EmbreeHandle<RTCGeometryTy>;

/// Triangles as Embree takes them.
struct EmbreeTriangles {
  std::vector<std::array<float, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A new buffer of `count` items of `width` scalars each. Embree pads it as its vector loads need.
template <typename Scalar>
Scalar* new_embree_buffer(const EmbreeGeometry& geometry, RTCBufferType type, RTCFormat format, std::size_t width,
                          std::size_t count) {
  void* const memory = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, width * sizeof(Scalar), count);
  if (!memory) throw std::runtime_error("Embree has no memory for a buffer");
  return static_cast<Scalar*>(memory);
}

/// A geometry with a copy of the triangles, not committed yet.
EmbreeGeometry embree_geometry(RTCDevice device, const EmbreeTriangles& triangles);

/// The ray in single precision.
RTCRay embree_ray(const Ray& ray);

/// The closest hit, with geomID RTC_INVALID_GEOMETRY_ID on a miss.
RTCRayHit embree_intersect(RTCScene scene, const Ray& ray);

bool embree_occluded(RTCScene scene, const Ray& ray);

}  // namespace shaolin
