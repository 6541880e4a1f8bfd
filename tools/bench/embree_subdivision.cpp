#include "tools/bench/embree_subdivision.h"

#include <cstdint>
#include <limits>

#include "schemes/errors.h"

namespace shaolin {
namespace {

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

void set_faces(const EmbreeGeometry& geometry, const ControlMesh& mesh) {
  auto* sizes = new_embree_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT, 1,
                                                 static_cast<std::size_t>(mesh.face_count()));
  for (int face = 0; face < mesh.face_count(); ++face) *sizes++ = static_cast<std::uint32_t>(mesh.face_size(face));
  auto* indices =
      new_embree_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, 1, mesh.face_vertices.size());
  for (const int vertex : mesh.face_vertices) *indices++ = static_cast<std::uint32_t>(vertex);
  auto* points =
      new_embree_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, mesh.positions.size());
  for (const Vec3& point : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) *points++ = static_cast<float>(point[axis]);
}

void set_tags(const EmbreeGeometry& geometry, const ControlMesh& mesh) {
  if (!mesh.sharp_edges.empty()) {
    const std::size_t count = mesh.sharp_edges.size();
    auto* ends =
        new_embree_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, 2, count);
    auto* weights = new_embree_buffer<float>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT, 1, count);
    for (const SharpEdge& edge : mesh.sharp_edges) {
      *ends++ = static_cast<std::uint32_t>(edge.a);
      *ends++ = static_cast<std::uint32_t>(edge.b);
      *weights++ = embree_sharpness(edge.sharpness);
    }
  }
  if (!mesh.sharp_vertices.empty()) {
    const std::size_t count = mesh.sharp_vertices.size();
    auto* vertices =
        new_embree_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT, 1, count);
    auto* weights =
        new_embree_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT, 1, count);
    for (const SharpVertex& corner : mesh.sharp_vertices) {
      *vertices++ = static_cast<std::uint32_t>(corner.vertex);
      *weights++ = embree_sharpness(corner.sharpness);
    }
  }
}

}  // namespace

EmbreeGeometry embree_subdivision(RTCDevice device, const ControlMesh& mesh, int level) {
  if (mesh.crease_method == CreaseMethod::chaikin) throw InputError("Embree has no Chaikin creases");
  if (mesh.triangle_subdivision == TriangleSubdivision::smooth) throw InputError("Embree has no smooth triangles");
  if (!mesh.cones.empty()) throw InputError("Embree has no conical vertices");
  if (!mesh.holes.empty()) throw InputError("Embree rounds the mesh off around a hole as at a boundary");
  EmbreeGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SUBDIVISION));
  set_faces(geometry, mesh);
  set_tags(geometry, mesh);
  rtcSetGeometrySubdivisionMode(geometry.get(), 0, subdivision_mode(mesh.boundary));
  rtcSetGeometryTessellationRate(geometry.get(), static_cast<float>(1 << level));
  return geometry;
}

}  // namespace shaolin
