#include "tools/validate/quad_oracle.h"

#include <boost/math/constants/constants.hpp>

#include "schemes/builtin.h"

namespace shaolin {
namespace {

using OpenSubdiv::Sdc::SchemeType;

/// Loop 1987: the square is not optional.
VertexWeights<Quad> loop_weights(int n) {
  const Quad root = Quad(3) / 8 + cos(boost::math::constants::two_pi<Quad>() / n) / 4;
  const Quad edge = (Quad(5) / 8 - root * root) / n;
  return {1 - n * edge, edge, 0};
}

VertexWeights<Quad> catmark_weights(int n) { return {Quad(n - 2) / n, Quad(1) / (n * n), Quad(1) / (n * n)}; }

VertexWeightsOf<Quad> weights_of(const std::string& scheme, const SchemeMasks& masks) {
  return [&masks, scheme](int n, RingRule rule) -> VertexWeights<Quad> {
    if (rule != RingRule::cone && scheme == "loop") return loop_weights(n);
    if (rule != RingRule::cone && scheme == "catmark") return catmark_weights(n);
    const VertexMask mask = vertex_mask(masks, n, rule);
    return {mask.vertex, mask.edge, mask.face};
  };
}

std::vector<QuadVec3> to_quads(const std::vector<Vec3>& points) {
  std::vector<QuadVec3> result;
  for (const Vec3& p : points) result.push_back(p.cast<Quad>());
  return result;
}

}  // namespace

QuadOracle::QuadOracle(const ControlMesh& mesh, const std::string& scheme)
    : masks_(builtin_masks(scheme)), weights_(weights_of(scheme, *masks_)), root_(make_root(mesh)) {}

RootMesh QuadOracle::make_root(const ControlMesh& mesh) {
  const bool triangular = masks_->face_kind() == FaceKind::triangle;
  const SubdivisionRules rules = rules_of(mesh, triangular ? SchemeType::SCHEME_LOOP : SchemeType::SCHEME_CATMARK);
  RootMesh root(mesh, rules, [&](const TaggedMesh& coarse) {
    Refined fine = refine(coarse, rules, *masks_);
    root_points_ = refine_points(coarse, to_quads(coarse.points), fine, rules, *masks_, weights_);
    return fine;
  });
  if (root_points_.empty()) root_points_ = to_quads(root.mesh.points);
  return root;
}

QuadVec3 QuadOracle::position(const SurfaceParameter& at) const {
  constexpr int rings = 2;  // masks of radius 1 read one; a cut makes the points at its rim wrong
  constexpr int most_levels = 200;
  const RootMesh::Place place = root_.place_of(at);
  double u = place.u, v = place.v;
  const TaggedMesh* mesh = &root_.mesh;
  std::vector<QuadVec3> points = root_points_;
  Refined fine;
  int face = place.face;
  for (int level = 0; level < most_levels; ++level) {
    const CutOut cut = cut_neighbourhood(*mesh, face, rings);
    std::vector<QuadVec3> kept(cut.mesh.points.size(), QuadVec3::Zero());
    for (const auto& [from, to] : cut.vertex_index)
      kept[static_cast<std::size_t>(to)] = points[static_cast<std::size_t>(from)];
    face = cut.face_index.at(face);
    const auto corners = cut.mesh.face_vertices[face];
    const QuadVec3& origin = kept[static_cast<std::size_t>(corners[0])];
    Quad size = 0;
    for (const int vertex : corners)
      size = std::max(size, Quad((kept[static_cast<std::size_t>(vertex)] - origin).cwiseAbs().maxCoeff()));
    if (size <= Quad(root_.diagonal) * Quad(0x1p-90)) return origin;
    fine = refine(cut.mesh, root_.rules);
    points = refine_points(cut.mesh, kept, fine, root_.rules, *masks_, weights_);
    const ChildPlace in = child_place(root_.rules.triangular(), u, v);
    u = in.u, v = in.v;
    face = fine.face_children[face][in.child];
    mesh = &fine.mesh;
  }
  return points[static_cast<std::size_t>(mesh->face_vertices[face][0])];
}

}  // namespace shaolin
