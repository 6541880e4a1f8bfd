// OpenMesh as a peer: its uniform subdividers, which take no tags.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/config.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#include <stdexcept>

#include "tools/validate/peer.h"

namespace shaolin {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

template <class Mesh>
void build(Mesh& mesh, const ControlMesh& control) {
  std::vector<OpenMesh::VertexHandle> vertices;
  for (const Vec3& p : control.positions) vertices.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (int f = 0; f < control.face_count(); ++f) {
    std::vector<OpenMesh::VertexHandle> face;
    for (const int v : control.face(f)) face.push_back(vertices[static_cast<std::size_t>(v)]);
    if (!mesh.add_face(face).is_valid()) throw std::runtime_error("declines a face");
  }
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_halfedge_status();
  mesh.request_face_status();
  mesh.delete_isolated_vertices();
  mesh.garbage_collection();
}

template <class Mesh, class Subdivider>
std::vector<Vec3> refined(const ControlMesh& control) {
  Mesh mesh;
  build(mesh, control);
  Subdivider subdivider;
  subdivider.attach(mesh);
  if (!subdivider(peer_levels)) throw std::runtime_error("fails");
  subdivider.detach();
  std::vector<Vec3> points;
  for (const auto v : mesh.vertices()) points.push_back({mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]});
  return points;
}

class OpenMeshPeer final : public Peer {
 public:
  std::string name() const override { return "OpenMesh"; }
  std::string version() const override { return std::to_string(OM_GET_VER) + '.' + std::to_string(OM_GET_MAJ); }
  bool offers(const PeerCase& of) const override {
    return (of.scheme == "loop" || of.scheme == "catmark" || of.scheme == "butterfly") && has_no_tags(of.mesh);
  }
  double error(const PeerCase& of) const override {
    namespace Uniform = OpenMesh::Subdivider::Uniform;
    const std::vector<Vec3> points =
        of.scheme == "loop"      ? refined<Triangles, Uniform::LoopT<Triangles, double>>(of.mesh)
        : of.scheme == "catmark" ? refined<Polygons, Uniform::CatmullClarkT<Polygons, double>>(of.mesh)
                                 : refined<Triangles, Uniform::ModifiedButterflyT<Triangles, double>>(of.mesh);
    return set_distance(points, plainly_refined(of), of.mesh);
  }
};

}  // namespace

std::unique_ptr<const Peer> openmesh_peer() { return std::make_unique<OpenMeshPeer>(); }

}  // namespace shaolin
