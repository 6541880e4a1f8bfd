#include "tools/validate/oracle.h"

#include <opensubdiv/bfr/refinerSurfaceFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "schemes/errors.h"
#include "tools/validate/corner_chain.h"
#include "tools/validate/corner_limit.h"
#include "tools/validate/face_list.h"

namespace shaolin {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

SubdivisionRules rules_of(const ControlMesh& mesh, const std::string& scheme) {
  static const std::map<std::string, Sdc::SchemeType> known{
      {"loop", Sdc::SCHEME_LOOP}, {"catmark", Sdc::SCHEME_CATMARK}, {"bilinear", Sdc::SCHEME_BILINEAR}};
  const auto at = known.find(scheme);
  if (at == known.end())
    throw InputError("OpenSubdiv has no scheme '" + scheme +
                     "' to hold it against; expected loop, catmark or bilinear");
  if (!mesh.cones.empty()) throw InputError("OpenSubdiv has no conical vertices to hold the surface against");
  SubdivisionRules rules{at->second, {}};
  rules.options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  rules.options.SetCreasingMethod(mesh.crease_method == CreaseMethod::chaikin ? Sdc::Options::CREASE_CHAIKIN
                                                                              : Sdc::Options::CREASE_UNIFORM);
  rules.options.SetTriangleSubdivision(mesh.triangle_subdivision == TriangleSubdivision::smooth
                                           ? Sdc::Options::TRI_SUB_SMOOTH
                                           : Sdc::Options::TRI_SUB_CATMARK);
  return rules;
}

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

/// OpenSubdiv's base level, with the boundary option and the holes as given.
std::unique_ptr<Far::TopologyRefiner> control_refiner(const ControlMesh& mesh, SubdivisionRules rules) {
  if (rules.triangular()) expect_triangles(mesh);
  rules.options.SetVtxBoundaryInterpolation(boundary_of(mesh.boundary));
  try {
    return make_refiner(face_list(mesh), rules);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

/// True if the surface at the vertex is a single regular piece, or two along a crease, once semi-sharp tags are gone.
bool is_regular(const TaggedMesh& mesh, const SubdivisionRules& rules, int face, int corner) {
  const int vertex = mesh.face_vertices[face][corner];
  const int full_turn = rules.triangular() ? 6 : 4;
  const int fan_size = mesh.vertex_faces.count(vertex);
  const Sector sector = sector_around(mesh, face, corner);
  const bool sharp = mesh.vertex_sharpness[vertex] >= infinite_sharpness;
  if (sharp) return !sector.closed && sector.size() == 1 && fan_size == 1;
  if (sector.closed) return sector.size() == full_turn && fan_size == sector.size();
  return sector.size() == full_turn / 2 && crease_count(mesh, vertex) == 2 &&
         (fan_size == full_turn || fan_size == full_turn / 2);
}

/// Where a corner of a quad or triangle is in its face's frame.
constexpr std::array<std::array<int, 2>, 4> quad_corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
constexpr std::array<std::array<int, 2>, 3> triangle_corners{{{0, 0}, {1, 0}, {0, 1}}};

LimitSample sample_of(const SurfaceValues& values) {
  LimitSample sample{values.position, values.du.cross(values.dv),
                     Derivatives{values.du, values.dv, values.duu, values.duv, values.dvv}};
  const double area = sample.normal.norm();
  if (area > 0) sample.normal /= area;
  return sample;
}

}  // namespace

class Oracle::Implementation {
 public:
  Implementation(const ControlMesh& mesh, const std::string& scheme, const OracleOptions& options);

  std::optional<LimitSample> evaluate(const SurfaceParameter& at);

  double diagonal;
  SubdivisionRules rules;
  std::vector<char> has_limit;
  std::vector<int> sub_counts;

 private:
  /// A point of a face of root_: its own u, v are `scale` times finer than the caller's.
  struct Place {
    int face;
    double u, v;
    double scale;
  };
  /// Chains by vertex. They are dropped all at once when they hold more than so many faces: those that are needed are
  /// quick to build again, but for the few of heavy vertices.
  struct Chains {
    std::size_t most_faces, faces = 0;
    std::unordered_map<int, std::unique_ptr<CornerChain>> by_vertex{};
  };
  struct CornerKind {
    bool irregular, heavy, beside_heavy;
  };

  Place place_of(const SurfaceParameter& at) const;
  int face_corners() const { return rules.face_size(); }
  std::array<int, 2> corner_position(int corner) const {
    return rules.triangular() ? triangle_corners[static_cast<std::size_t>(corner)]
                              : quad_corners[static_cast<std::size_t>(corner)];
  }
  double distance(const Place& at, int corner) const;
  bool is_heavy(int vertex) const { return root_.vertex_faces.count(vertex) > options_.heavy_valence; }
  bool is_beside_heavy(int vertex) const;
  const std::array<CornerKind, 4>& kinds(int face);
  std::optional<int> corner_to_refine(const Place& at);
  LimitSample at_corner(int face, int corner);
  SurfaceValues near_corner(const Place& at, int corner);
  SurfaceValues by_chain(Chains& chains, const TaggedMesh& mesh, const Place& at, int corner);

  OracleOptions options_;
  TaggedMesh root_;         // the control mesh, or its first refinement if that has other faces than root's
  Relation face_children_;  // per control face: its faces in root_; empty without refinement
  Bfr::SurfaceFactoryCache cache_;
  std::unordered_map<int, std::array<CornerKind, 4>> kinds_;
  std::unordered_map<int, std::unique_ptr<Piece>> pieces_;
  std::optional<Refined> finer_;  // root_ once more, if needed
  bool wide_chains_;
  Chains light_{1'000'000}, heavy_{5'000'000}, finer_light_{1'000'000};
  std::map<std::pair<int, int>, CornerLimit> limits_;
};

Oracle::Implementation::Implementation(const ControlMesh& mesh, const std::string& scheme, const OracleOptions& options)
    : rules(rules_of(mesh, scheme)), options_(options) {
  const auto refiner = control_refiner(mesh, rules);
  Vec3 lower = mesh.positions.front(), upper = lower;
  for (const Vec3& p : mesh.positions) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  diagonal = (upper - lower).norm();
  const Bfr::RefinerSurfaceFactory<> factory(*refiner);
  bool all_regular = true;
  for (int f = 0; f < mesh.face_count(); ++f) {
    has_limit.push_back(factory.FaceHasLimitSurface(f));
    const bool regular = mesh.face_size(f) == rules.face_size();
    sub_counts.push_back(regular ? 1 : mesh.face_size(f));
    all_regular = all_regular && regular;
  }
  root_ = tagged_level(refiner->GetLevel(0), mesh.positions);
  wide_chains_ = may_need_children(root_, rules);
  if (all_regular) return;
  Refined fine = refine(root_, rules);
  root_ = std::move(fine.mesh);
  face_children_ = std::move(fine.face_children);
}

Oracle::Implementation::Place Oracle::Implementation::place_of(const SurfaceParameter& at) const {
  double u = std::clamp(at.u, 0.0, 1.0), v = std::clamp(at.v, 0.0, 1.0);
  if (rules.triangular() && u + v > 1) v = 1 - u;
  if (face_children_.size() == 0) return {at.face, u, v, 1};
  if (sub_counts[at.face] > 1) return {face_children_[at.face][at.sub], u, v, 1};
  const ChildParameter in = child_parameter(false, u, v);
  return {face_children_[at.face][in.child], in.u, in.v, 2};
}

/// In the parameter square; on triangles 1 - the corner's barycentric coordinate.
double Oracle::Implementation::distance(const Place& at, int corner) const {
  const auto [cu, cv] = corner_position(corner);
  const double du = std::abs(at.u - cu), dv = std::abs(at.v - cv);
  if (!rules.triangular()) return std::max(du, dv);
  return corner == 0 ? du + dv : corner == 1 ? du : dv;
}

bool Oracle::Implementation::is_beside_heavy(int vertex) const {
  const auto fan = root_.vertex_faces[vertex];
  return std::any_of(fan.begin(), fan.end(), [&](int f) {
    const auto face = root_.face_vertices[f];
    return std::any_of(face.begin(), face.end(), [&](int v) { return is_heavy(v); });
  });
}

const std::array<Oracle::Implementation::CornerKind, 4>& Oracle::Implementation::kinds(int face) {
  const auto [at, is_new] = kinds_.try_emplace(face);
  for (int c = 0; is_new && c < face_corners(); ++c) {
    const int vertex = root_.face_vertices[face][c];
    const bool heavy = is_heavy(vertex), irregular = heavy || !is_regular(root_, rules, face, c);
    at->second[c] = {irregular, heavy, irregular && !heavy && is_beside_heavy(vertex)};
  }
  return at->second;
}

/// The corner whose neighbourhood must be refined: an irregular one within the zone, else the nearest heavy one.
std::optional<int> Oracle::Implementation::corner_to_refine(const Place& at) {
  const auto& kind = kinds(at.face);
  std::optional<int> nearest;
  for (int c = 0; c < face_corners(); ++c) {
    const bool candidate = kind[c].heavy || (kind[c].irregular && distance(at, c) <= options_.zone);
    if (candidate && (!nearest || distance(at, c) < distance(at, *nearest))) nearest = c;
  }
  return nearest;
}

LimitSample Oracle::Implementation::at_corner(int face, int corner) {
  auto found = limits_.find({face, corner});
  if (found == limits_.end()) {
    found = limits_.emplace(std::pair(face, corner), corner_limit(root_, rules, face, corner)).first;
  }
  return {found->second.position, found->second.normal, std::nullopt};
}

/// After `level` steps the distance d 2^level lies in (1/2, 1]: in the corner's child, but not in that one's own.
SurfaceValues Oracle::Implementation::by_chain(Chains& chains, const TaggedMesh& mesh, const Place& at, int corner) {
  int exponent;
  const double mantissa = std::frexp(distance(at, corner), &exponent);
  const int level = -exponent + (mantissa == 0.5);
  const auto [cu, cv] = corner_position(corner);
  const double u = cu + std::ldexp(at.u - cu, level), v = cv + std::ldexp(at.v - cv, level);
  if (chains.faces > chains.most_faces) chains.by_vertex.clear(), chains.faces = 0;
  const int vertex = mesh.face_vertices[at.face][corner];
  std::unique_ptr<CornerChain>& chain = chains.by_vertex[vertex];
  if (!chain) chain = std::make_unique<CornerChain>(mesh, rules, vertex, wide_chains_, cache_);
  const std::size_t before = chain->size();
  SurfaceValues values = chain->evaluate(at.face, corner, level, u, v);
  chains.faces += chain->size() - before;
  values.rescale(at.scale);
  return values;
}

/// A corner beside a heavy one starts from the mesh refined once more as a whole. There the heavy vertex is two rings
/// away and its many faces stay out of the corner's chain; else each corner of a large n-gon would drag them along.
SurfaceValues Oracle::Implementation::near_corner(const Place& at, int corner) {
  const CornerKind& kind = kinds(at.face)[corner];
  if (kind.heavy) return by_chain(heavy_, root_, at, corner);
  if (!kind.beside_heavy || distance(at, corner) > 0.5) return by_chain(light_, root_, at, corner);
  if (!finer_) finer_ = refine(root_, rules);
  const auto [cu, cv] = corner_position(corner);  // the corner's child has the same corner, at the same place
  const Place child{finer_->face_children[at.face][corner], cu + 2 * (at.u - cu), cv + 2 * (at.v - cv), 2 * at.scale};
  return by_chain(finer_light_, finer_->mesh, child, corner);
}

std::optional<LimitSample> Oracle::Implementation::evaluate(const SurfaceParameter& parameter) {
  if (parameter.sub < 0 || parameter.sub >= sub_counts.at(static_cast<std::size_t>(parameter.face))) {
    throw std::out_of_range("sub-face " + std::to_string(parameter.sub) + " of face " + std::to_string(parameter.face));
  }
  if (!has_limit[parameter.face]) return std::nullopt;
  const Place at = place_of(parameter);
  const std::optional<int> corner = corner_to_refine(at);
  if (corner && distance(at, *corner) < std::ldexp(1, -CornerChain::max_level)) return at_corner(at.face, *corner);
  if (corner) return sample_of(near_corner(at, *corner));
  std::unique_ptr<Piece>& piece = pieces_[at.face];
  if (!piece) piece = std::make_unique<Piece>(root_, at.face, rules, cache_);
  SurfaceValues values = piece->evaluate(at.u, at.v);
  values.rescale(at.scale);
  return sample_of(values);
}

Oracle::Oracle(const ControlMesh& mesh, const std::string& scheme, const OracleOptions& options)
    : implementation_(std::make_unique<Implementation>(mesh, scheme, options)) {}
Oracle::~Oracle() = default;
Oracle::Oracle(Oracle&&) noexcept = default;

int Oracle::face_count() const { return static_cast<int>(implementation_->sub_counts.size()); }
bool Oracle::triangular() const { return implementation_->rules.triangular(); }
bool Oracle::has_limit(int face) const { return implementation_->has_limit.at(static_cast<std::size_t>(face)); }
int Oracle::sub_count(int face) const { return implementation_->sub_counts.at(static_cast<std::size_t>(face)); }
double Oracle::diagonal() const { return implementation_->diagonal; }

std::optional<LimitSample> Oracle::evaluate(const SurfaceParameter& at) const { return implementation_->evaluate(at); }

}  // namespace shaolin
