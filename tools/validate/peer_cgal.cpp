// CGAL as a peer: Subdivision_method_3, which has no tags.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/version.h>

#include <stdexcept>

#include "tools/validate/peer.h"

namespace shaolin {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

CgalMesh cgal_mesh(const ControlMesh& control) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> vertices;
  for (const Vec3& p : control.positions) vertices.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (int f = 0; f < control.face_count(); ++f) {
    std::vector<CgalMesh::Vertex_index> face;
    for (const int v : control.face(f)) face.push_back(vertices[static_cast<std::size_t>(v)]);
    if (mesh.add_face(face) == CgalMesh::null_face()) throw std::runtime_error("declines a face");
  }
  for (const auto v : vertices)
    if (mesh.is_isolated(v)) mesh.remove_vertex(v);
  mesh.collect_garbage();
  return mesh;
}

class CgalPeer final : public Peer {
 public:
  std::string name() const override { return "CGAL"; }
  std::string version() const override { return CGAL_VERSION_STR; }
  bool offers(const PeerCase& of) const override {
    return (of.scheme == "loop" || of.scheme == "catmark") && has_no_tags(of.mesh);
  }
  double error(const PeerCase& of) const override {
    CgalMesh mesh = cgal_mesh(of.mesh);
    const auto steps = CGAL::parameters::number_of_iterations(peer_levels);
    if (of.scheme == "loop") CGAL::Subdivision_method_3::Loop_subdivision(mesh, steps);
    if (of.scheme == "catmark") CGAL::Subdivision_method_3::CatmullClark_subdivision(mesh, steps);
    std::vector<Vec3> points;
    for (const auto v : mesh.vertices()) points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
    return set_distance(points, plainly_refined(of), of.mesh);
  }
};

}  // namespace

std::unique_ptr<const Peer> cgal_peer() { return std::make_unique<CgalPeer>(); }

}  // namespace shaolin
