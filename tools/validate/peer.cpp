#include "tools/validate/peer.h"

#include <algorithm>
#include <limits>
#include <map>

#include "tools/validate/mask_refinement.h"
#include "tools/validate/root_mesh.h"

namespace shaolin {
namespace {

/// Of the points, the one that is farthest from all others; these are searched in the order of x.
double farthest_from(const std::vector<Vec3>& points, std::vector<Vec3> others) {
  std::sort(others.begin(), others.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  double farthest = 0;
  for (const Vec3& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    const auto from =
        std::lower_bound(others.begin(), others.end(), p.x(), [](const Vec3& q, double x) { return q.x() < x; });
    for (auto q = from; q != others.end() && q->x() - p.x() <= nearest; ++q)
      nearest = std::min(nearest, (p - *q).norm());
    for (auto q = from; q != others.begin() && p.x() - (q - 1)->x() <= nearest; --q)
      nearest = std::min(nearest, (p - *(q - 1)).norm());
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

/// Faces at each edge, however it runs.
std::map<std::pair<int, int>, int> faces_at_edges(const ControlMesh& mesh) {
  std::map<std::pair<int, int>, int> faces;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 0; i < face.size(); ++i) ++faces[std::minmax({face[i], face[(i + 1) % face.size()]})];
  }
  return faces;
}

}  // namespace

std::vector<std::unique_ptr<const Peer>> peers() {
  std::vector<std::unique_ptr<const Peer>> all;
  all.push_back(bfr_peer());
  all.push_back(far_peer());
  all.push_back(cgal_peer());
  all.push_back(openmesh_peer());
  return all;
}

std::vector<Vec3> plainly_refined(const PeerCase& of) {
  const bool triangular = of.masks->face_kind() == FaceKind::triangle;
  const SubdivisionRules rules = rules_of(
      of.mesh, triangular ? OpenSubdiv::Sdc::SchemeType::SCHEME_LOOP : OpenSubdiv::Sdc::SchemeType::SCHEME_CATMARK);
  const auto step = [&](const TaggedMesh& mesh) { return refine(mesh, rules, *of.masks); };
  RootMesh root(of.mesh, rules, step);
  for (int level = root.face_children.size() > 0; level < peer_levels; ++level)
    root.mesh = std::move(step(root.mesh).mesh);
  return std::move(root.mesh.points);
}

double set_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const ControlMesh& mesh) {
  return std::max(farthest_from(a, b), farthest_from(b, a)) / mesh.diagonal();
}

std::string shape_class(const ControlMesh& mesh) {
  std::string text;
  const auto add = [&](const char* word, bool applies) {
    if (applies) text += (text.empty() ? "" : ", ") + std::string(word);
  };
  std::vector<int> faces(mesh.positions.size(), 0), open_edges(mesh.positions.size(), 0);
  bool boundary = false, wild = false;
  for (const auto& [edge, count] : faces_at_edges(mesh)) {
    boundary |= count == 1;
    wild |= count > 2 || edge.first == edge.second;
    if (count != 1) continue;
    wild |= ++open_edges[static_cast<std::size_t>(edge.first)] > 2;
    wild |= ++open_edges[static_cast<std::size_t>(edge.second)] > 2;
  }
  for (const int v : mesh.face_vertices) ++faces[static_cast<std::size_t>(v)];
  bool two = false, ngons = false;
  for (std::size_t v = 0; v < faces.size(); ++v) two |= faces[v] == 2 && open_edges[v] == 0;
  const bool triangles = mesh.all_triangles();
  for (int f = 0; f < mesh.face_count(); ++f) ngons |= !triangles && mesh.face_size(f) != 4;
  const auto infinite = [](float sharpness) { return sharpness >= infinite_sharpness; };
  const auto any_edge = [&](bool sharp) {
    return std::any_of(mesh.sharp_edges.begin(), mesh.sharp_edges.end(),
                       [&](const SharpEdge& e) { return e.sharpness > 0 && infinite(e.sharpness) == sharp; });
  };
  add("boundary", boundary);
  add("closed", !boundary);
  add("corners of the boundary", boundary && mesh.boundary == BoundaryInterpolation::edge_and_corner);
  add("open boundary", boundary && mesh.boundary == BoundaryInterpolation::none);
  add("n-gons", ngons);
  add("valence 2", two);
  add("creases", any_edge(true));
  add("semi-sharp", any_edge(false));
  add("sharp vertices", !mesh.sharp_vertices.empty());
  add("Chaikin", mesh.crease_method == CreaseMethod::chaikin);
  add("smooth triangles", mesh.triangle_subdivision == TriangleSubdivision::smooth);
  add("holes", !mesh.holes.empty());
  add("non-manifold", wild);
  return text;
}

bool has_no_tags(const ControlMesh& mesh) {
  const bool is_plain = mesh.sharp_edges.empty() && mesh.sharp_vertices.empty() && mesh.cones.empty() &&
                        mesh.holes.empty() && mesh.triangle_subdivision == TriangleSubdivision::catmark;
  if (!is_plain) return false;
  const auto edges = faces_at_edges(mesh);
  const bool closed = std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second != 1; });
  return closed || mesh.boundary == BoundaryInterpolation::edge_only;
}

}  // namespace shaolin
