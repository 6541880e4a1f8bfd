#include "tools/bench/embree_scene.h"

#include <cstdint>
#include <limits>
#include <stdexcept>

#include "schemes/errors.h"
#include "tools/bench/tessellation.h"

namespace shaolin {
namespace {

struct ReleaseGeometry {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using Geometry = std::unique_ptr<RTCGeometryTy, ReleaseGeometry>;

/// A new buffer of `count` items of `width` scalars each. Embree pads it as its vector loads need.
template <typename Scalar>
Scalar* new_buffer(const Geometry& geometry, RTCBufferType type, RTCFormat format, std::size_t width,
                   std::size_t count) {
  void* const memory = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, width * sizeof(Scalar), count);
  if (!memory) throw std::runtime_error("Embree has no memory for a buffer");
  return static_cast<Scalar*>(memory);
}

/// Embree lets sharpness decay for ever; ours is infinite from infinite_sharpness on.
float embree_sharpness(float sharpness) {
  return sharpness >= infinite_sharpness ? std::numeric_limits<float>::infinity() : sharpness;
}

RTCSubdivisionMode subdivision_mode(BoundaryInterpolation boundary) {
  switch (boundary) {
    case BoundaryInterpolation::none:
      return RTC_SUBDIVISION_MODE_NO_BOUNDARY;
    case BoundaryInterpolation::edge_only:
      return RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY;
    case BoundaryInterpolation::edge_and_corner:
      break;
  }
  return RTC_SUBDIVISION_MODE_PIN_CORNERS;
}

void set_faces(const Geometry& geometry, const ControlMesh& mesh) {
  auto* sizes = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, 1,
                                          static_cast<std::size_t>(mesh.face_count()));
  for (int face = 0; face < mesh.face_count(); ++face) *sizes++ = static_cast<std::uint32_t>(mesh.face_size(face));
  auto* indices =
      new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 1, mesh.face_vertices.size());
  for (const int vertex : mesh.face_vertices) *indices++ = static_cast<std::uint32_t>(vertex);
  auto* points = new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, mesh.positions.size());
  for (const Vec3& point : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(point[axis]);
}

void set_tags(const Geometry& geometry, const ControlMesh& mesh) {
  if (!mesh.sharp_edges.empty()) {
    const std::size_t count = mesh.sharp_edges.size();
    auto* ends = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, 2, count);
    auto* weights = new_buffer<float>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, 1, count);
    for (const SharpEdge& edge : mesh.sharp_edges) {
      *ends++ = static_cast<std::uint32_t>(edge.a);
      *ends++ = static_cast<std::uint32_t>(edge.b);
      *weights++ = embree_sharpness(edge.sharpness);
    }
  }
  if (!mesh.sharp_vertices.empty()) {
    const std::size_t count = mesh.sharp_vertices.size();
    auto* vertices =
        new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, 1, count);
    auto* weights = new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, 1, count);
    for (const SharpVertex& corner : mesh.sharp_vertices) {
      *vertices++ = static_cast<std::uint32_t>(corner.vertex);
      *weights++ = embree_sharpness(corner.sharpness);
    }
  }
}

Geometry subdivision_geometry(RTCDevice device, const ControlMesh& mesh, int level) {
  if (mesh.crease_method == CreaseMethod::chaikin) throw InputError("Embree has no Chaikin creases");
  if (mesh.triangle_subdivision == TriangleSubdivision::smooth) throw InputError("Embree has no smooth triangles");
  if (!mesh.holes.empty()) throw InputError("Embree rounds the mesh off around a hole as at a boundary");
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SUBDIVISION));
  set_faces(geometry, mesh);
  set_tags(geometry, mesh);
  rtcSetGeometrySubdivisionMode(geometry.get(), 0, subdivision_mode(mesh.boundary));
  rtcSetGeometryTessellationRate(geometry.get(), static_cast<float>(1 << level));
  return geometry;
}

Geometry triangle_geometry(RTCDevice device, const Tessellation& tessellation) {
  Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* points = new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, tessellation.points.size());
  for (const auto& point : tessellation.points)
    for (const float coordinate : point) *points++ = coordinate;
  auto* indices =
      new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, 3, tessellation.triangles.size());
  for (const auto& triangle : tessellation.triangles)
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

}  // namespace

EmbreeScene::EmbreeScene(const ControlMesh& mesh, const std::string& scheme, int level)
    : device_(rtcNewDevice("threads=1")) {
  if (!device_) throw std::runtime_error("Embree does not start");
  scene_.reset(rtcNewScene(device_.get()));
  const Geometry geometry = scheme == "loop" ? triangle_geometry(device_.get(), tessellate_loop(mesh, level))
                                             : subdivision_geometry(device_.get(), mesh, level);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build this scene");
}

std::optional<EmbreeScene::Hit> EmbreeScene::intersect(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit found{};
  found.ray = embree_ray(ray);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_.get(), &context, &found);
  if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{found.ray.tfar, Vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z).normalized()};
}

bool EmbreeScene::occluded(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay shadow = embree_ray(ray);
  rtcOccluded1(scene_.get(), &context, &shadow);
  return shadow.tfar < 0;  // Embree's mark for "occluded"
}

}  // namespace shaolin
