#include "tools/validate/root_mesh.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>

#include <algorithm>
#include <stdexcept>

#include "schemes/errors.h"
#include "tools/validate/face_list.h"

namespace shaolin {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

Sdc::Options::VtxBoundaryInterpolation boundary_of(BoundaryInterpolation boundary) {
  switch (boundary) {
    case BoundaryInterpolation::none:
      return Sdc::Options::VTX_BOUNDARY_NONE;
    case BoundaryInterpolation::edge_only:
      return Sdc::Options::VTX_BOUNDARY_EDGE_ONLY;
    case BoundaryInterpolation::edge_and_corner:
      break;
  }
  return Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
}

void expect_triangles(const ControlMesh& mesh) {
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face_size(f) == 3) continue;
    throw InputError("face " + std::to_string(f) + " has " + std::to_string(mesh.face_size(f)) +
                     " corners; Loop subdivision expects triangles");
  }
}

}  // namespace

std::unique_ptr<Far::TopologyRefiner> control_refiner(const ControlMesh& mesh, SubdivisionRules rules) {
  if (rules.triangular()) expect_triangles(mesh);
  rules.options.SetVtxBoundaryInterpolation(boundary_of(mesh.boundary));
  try {
    return make_refiner(face_list(mesh), rules);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

SubdivisionRules rules_of(const ControlMesh& mesh, Sdc::SchemeType scheme) {
  SubdivisionRules rules{scheme, {}};
  rules.options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  rules.options.SetCreasingMethod(mesh.crease_method == CreaseMethod::chaikin ? Sdc::Options::CREASE_CHAIKIN
                                                                              : Sdc::Options::CREASE_UNIFORM);
  rules.options.SetTriangleSubdivision(mesh.triangle_subdivision == TriangleSubdivision::smooth
                                           ? Sdc::Options::TRI_SUB_SMOOTH
                                           : Sdc::Options::TRI_SUB_CATMARK);
  return rules;
}

RootMesh::RootMesh(const ControlMesh& control, const SubdivisionRules& its_rules, const Refine& refine)
    : rules(its_rules) {
  const auto refiner = control_refiner(control, rules);
  Vec3 lower = control.positions.front(), upper = lower;
  for (const Vec3& p : control.positions) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  diagonal = (upper - lower).norm();
  const Bfr::RefinerSurfaceFactory<> factory(*refiner);
  bool all_regular = true;
  for (int f = 0; f < control.face_count(); ++f) {
    has_limit.push_back(factory.FaceHasLimitSurface(f));
    const bool regular = control.face_size(f) == rules.face_size();
    sub_counts.push_back(regular ? 1 : control.face_size(f));
    all_regular = all_regular && regular;
  }
  mesh = tagged_level(refiner->GetLevel(0), control.positions);
  for (const int vertex : control.cones) mesh.vertex_cone[vertex] = 1;
  face_has_limit = has_limit;
  if (all_regular) return;
  Refined fine = refine(mesh);
  mesh = std::move(fine.mesh);
  face_children = std::move(fine.face_children);
  face_has_limit.assign(static_cast<std::size_t>(mesh.face_count()), 0);
  for (int f = 0; f < control.face_count(); ++f)
    for (const int child : face_children[f])
      face_has_limit[static_cast<std::size_t>(child)] = has_limit[static_cast<std::size_t>(f)];
}

RootMesh::Place RootMesh::place_of(const SurfaceParameter& at) const {
  if (at.sub < 0 || at.sub >= sub_counts.at(static_cast<std::size_t>(at.face)))
    throw std::out_of_range("sub-face " + std::to_string(at.sub) + " of face " + std::to_string(at.face));
  double u = std::clamp(at.u, 0.0, 1.0), v = std::clamp(at.v, 0.0, 1.0);
  if (rules.triangular() && u + v > 1) v = 1 - u;
  if (face_children.size() == 0) return {at.face, u, v, 1};
  if (sub_counts[static_cast<std::size_t>(at.face)] > 1) return {face_children[at.face][at.sub], u, v, 1};
  const ChildPlace in = child_place(false, u, v);
  return {face_children[at.face][in.child], in.u, in.v, 2};
}

bool RootMesh::is_inside(const SurfaceParameter& at) const {
  const Place place = place_of(at);
  const double u = place.u, v = place.v, far = rules.triangular() ? u + v : std::max(u, v);
  if (u > 0 && v > 0 && far < 1) return true;
  const auto has_limit_at = [&](int face) { return face_has_limit[static_cast<std::size_t>(face)] != 0; };
  // All around the corners that the point could belong to, a side's both ends: a little more than needed.
  for (int c = 0; c < rules.face_size(); ++c) {
    const int vertex = mesh.face_vertices[place.face][c];
    for (const int edge : mesh.vertex_edges[vertex])
      if (!mesh.is_manifold(edge)) return false;
    for (const int face : mesh.vertex_faces[vertex])
      if (!has_limit_at(face)) return false;
  }
  return true;
}

}  // namespace shaolin
