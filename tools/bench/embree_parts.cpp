#include "tools/bench/embree_parts.h"

namespace shaolin {

EmbreeGeometry embree_geometry(RTCDevice device, const EmbreeTriangles& triangles) {
  EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* points =
      new_embree_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, triangles.points.size());
  for (const auto& point : triangles.points)
    for (const float coordinate : point) *points++ = coordinate;
  auto* indices = new_embree_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3,
                                                   triangles.triangles.size());
  for (const auto& triangle : triangles.triangles)
    for (const std::uint32_t corner : triangle) *indices++ = corner;
  return geometry;
}

RTCRay embree_ray(const Ray& ray) {
  RTCRay result{};
  result.org_x = static_cast<float>(ray.origin.x());
  result.org_y = static_cast<float>(ray.origin.y());
  result.org_z = static_cast<float>(ray.origin.z());
  result.dir_x = static_cast<float>(ray.direction.x());
  result.dir_y = static_cast<float>(ray.direction.y());
  result.dir_z = static_cast<float>(ray.direction.z());
  result.tnear = static_cast<float>(ray.tmin);
  result.tfar = static_cast<float>(ray.tmax);
  result.mask = ~0u;
  return result;
}

RTCRayHit embree_intersect(RTCScene scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit found{};
  found.ray = embree_ray(ray);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &found);
  return found;
}

bool embree_occluded(RTCScene scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay shadow = embree_ray(ray);
  rtcOccluded1(scene, &context, &shadow);
  return shadow.tfar < 0;  // Embree's mark for "occluded"
}

}  // namespace shaolin
