#include "tools/validate/mask_oracle.h"

#include <cmath>
#include <deque>
#include <limits>

#include "tools/validate/agreement.h"
#include "tools/validate/mask_refinement.h"

namespace shaolin {
namespace {

using OpenSubdiv::Sdc::SchemeType;

/// Masks of radius 2 read the rings of a face's neighbours. Three rings around a face then hold three rings around each
/// of its children with a ring to spare, whose points a cut makes wrong.
constexpr int mask_rings = 3;

/// The faces shrink by more than this a level, or the scheme does not converge.
constexpr int most_mask_levels = 400;

/// A normal has settled if it has turned by no more over the last so many levels: a fifth of bar::normal.
constexpr int settling_levels = 8;
constexpr double settled = bar::normal / 5;

/// Normals of faces around a point turn by half as much a level, so that so many settle them. Not before the face has
/// left the corner that it began at, though: around a cone or a spike the normal depends on the side that the point
/// lies on, and a face that still holds the corner knows nothing of it.
constexpr int smooth_levels = 40;

/// Where a parameter stands to the nearest corner of its face.
struct FromCorner {
  int corner;
  double distance;

  int levels_to_settle() const {
    return distance > 0 ? smooth_levels + std::max(0, -std::ilogb(distance)) : settling_levels;
  }
};

FromCorner from_corner(bool triangular, double u, double v) {
  constexpr double corners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, triangle[3][2] = {{0, 0}, {1, 0}, {0, 1}};
  FromCorner nearest{0, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < (triangular ? 3 : 4); ++k) {
    const double* const corner = triangular ? triangle[k] : corners[k];
    const double distance = std::max(std::abs(u - corner[0]), std::abs(v - corner[1]));
    if (distance < nearest.distance) nearest = {k, distance};
  }
  return nearest;
}

RootMesh root_of(const ControlMesh& mesh, const SchemeMasks& masks) {
  const bool triangular = masks.face_kind() == FaceKind::triangle;
  const SubdivisionRules rules = rules_of(mesh, triangular ? SchemeType::SCHEME_LOOP : SchemeType::SCHEME_CATMARK);
  return {mesh, rules, [&](const TaggedMesh& coarse) { return refine(coarse, rules, masks); }};
}

/// Along du x dv; zero if it has no direction.
Vec3 normal_of(const TaggedMesh& mesh, int face) {
  const auto v = mesh.face_vertices[face];
  const auto p = [&](std::size_t i) -> const Vec3& { return mesh.points[static_cast<std::size_t>(v[i])]; };
  const Vec3 normal = v.size() == 3 ? (p(1) - p(0)).cross(p(2) - p(0)) : (p(2) - p(0)).cross(p(3) - p(1));
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3::Zero();
}

}  // namespace

MaskOracle::MaskOracle(const ControlMesh& mesh, std::shared_ptr<const SchemeMasks> masks)
    : Oracle(root_of(mesh, *masks)), masks_(std::move(masks)) {}

std::optional<LimitSample> MaskOracle::evaluate(const SurfaceParameter& parameter) const {
  const RootMesh::Place place = root_.place_of(parameter);
  if (!has_limit(parameter.face)) return std::nullopt;
  double u = place.u, v = place.v;
  CutOut cut = cut_neighbourhood(root_.mesh, place.face, mask_rings);
  int face = cut.face_index.at(place.face);
  Vec3 origin = Vec3::Zero();
  const FromCorner from = from_corner(triangular(), u, v);
  const int start = root_.mesh.face_vertices[place.face][static_cast<std::size_t>(from.corner)];
  const bool is_apex = from.distance == 0 && root_.mesh.vertex_cone[static_cast<std::size_t>(start)];
  std::deque<Vec3> normals;
  int level = 0;
  for (; level < most_mask_levels; ++level) {
    origin += cut.mesh.recentre(cut.mesh.face_vertices[face][0]);
    double size = 0;
    for (const int vertex : cut.mesh.face_vertices[face])
      size = std::max(size, cut.mesh.points[static_cast<std::size_t>(vertex)].norm());
    normals.push_back(normal_of(cut.mesh, face));
    if (static_cast<int>(normals.size()) > settling_levels) normals.pop_front();
    if (size <= 0x1p-54 * diagonal() && level >= from.levels_to_settle()) break;
    const Refined fine = refine(cut.mesh, root_.rules, *masks_);
    const ChildPlace in = child_place(triangular(), u, v);
    u = in.u, v = in.v;
    const int child = fine.face_children[face][in.child];
    cut = cut_neighbourhood(fine.mesh, child, mask_rings);
    face = cut.face_index.at(child);
  }
  const bool has_settled =
      !is_apex && level < most_mask_levels && angle_between_units(normals.front(), normals.back()) <= settled;
  return LimitSample{origin, has_settled ? normals.back() : Vec3::Zero(), std::nullopt};
}

}  // namespace shaolin
