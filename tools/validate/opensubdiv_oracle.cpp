#include "tools/validate/opensubdiv_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "schemes/errors.h"
#include "tools/validate/corner_chain.h"
#include "tools/validate/corner_limit.h"

namespace shaolin {

namespace Bfr = OpenSubdiv::Bfr;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

/// OpenSubdiv's schemes by their names here.
const std::map<std::string, Sdc::SchemeType> schemes{
    {"loop", Sdc::SCHEME_LOOP}, {"catmark", Sdc::SCHEME_CATMARK}, {"bilinear", Sdc::SCHEME_BILINEAR}};

RootMesh root_of(const ControlMesh& mesh, const std::string& scheme) {
  if (!mesh.cones.empty()) throw InputError("OpenSubdiv has no conical vertices to hold the surface against");
  const SubdivisionRules rules = rules_of(mesh, scheme_type(scheme));
  return {mesh, rules, [&](const TaggedMesh& coarse) { return refine(coarse, rules); }};
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

Sdc::SchemeType scheme_type(const std::string& scheme) {
  const auto at = schemes.find(scheme);
  if (at == schemes.end())
    throw InputError("OpenSubdiv has no scheme '" + scheme +
                     "' to hold it against; expected loop, catmark or bilinear");
  return at->second;
}

class OpenSubdivOracle::Implementation {
 public:
  Implementation(const RootMesh& base, const OracleOptions& options);

  std::optional<LimitSample> evaluate(const SurfaceParameter& at);

 private:
  using Place = RootMesh::Place;
  /// Chains by vertex. They are dropped all at once when they hold more than so many faces: those that are needed are
  /// quick to build again, but for the few of heavy vertices.
  struct Chains {
    std::size_t most_faces, faces = 0;
    std::unordered_map<int, std::unique_ptr<CornerChain>> by_vertex{};
  };
  struct CornerKind {
    bool irregular, heavy, beside_heavy;
  };

  int face_corners() const { return rules_.face_size(); }
  std::array<int, 2> corner_position(int corner) const {
    return rules_.triangular() ? triangle_corners[static_cast<std::size_t>(corner)]
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

  const RootMesh& base_;
  const SubdivisionRules& rules_;
  const TaggedMesh& root_;
  OracleOptions options_;
  Bfr::SurfaceFactoryCache cache_;
  std::unordered_map<int, std::array<CornerKind, 4>> kinds_;
  std::unordered_map<int, std::unique_ptr<Piece>> pieces_;
  std::optional<Refined> finer_;  // root_ once more, if needed
  bool wide_chains_;
  Chains light_{1'000'000}, heavy_{5'000'000}, finer_light_{1'000'000};
  std::map<std::pair<int, int>, CornerLimit> limits_;
};

OpenSubdivOracle::Implementation::Implementation(const RootMesh& base, const OracleOptions& options)
    : base_(base),
      rules_(base.rules),
      root_(base.mesh),
      options_(options),
      wide_chains_(may_need_children(root_, rules_)) {}

/// In the parameter square; on triangles 1 - the corner's barycentric coordinate.
double OpenSubdivOracle::Implementation::distance(const Place& at, int corner) const {
  const auto [cu, cv] = corner_position(corner);
  const double du = std::abs(at.u - cu), dv = std::abs(at.v - cv);
  if (!rules_.triangular()) return std::max(du, dv);
  return corner == 0 ? du + dv : corner == 1 ? du : dv;
}

bool OpenSubdivOracle::Implementation::is_beside_heavy(int vertex) const {
  const auto fan = root_.vertex_faces[vertex];
  return std::any_of(fan.begin(), fan.end(), [&](int f) {
    const auto face = root_.face_vertices[f];
    return std::any_of(face.begin(), face.end(), [&](int v) { return is_heavy(v); });
  });
}

const std::array<OpenSubdivOracle::Implementation::CornerKind, 4>& OpenSubdivOracle::Implementation::kinds(int face) {
  const auto [at, is_new] = kinds_.try_emplace(face);
  for (int c = 0; is_new && c < face_corners(); ++c) {
    const int vertex = root_.face_vertices[face][c];
    const bool heavy = is_heavy(vertex), irregular = heavy || !is_regular(root_, rules_, face, c);
    at->second[c] = {irregular, heavy, irregular && !heavy && is_beside_heavy(vertex)};
  }
  return at->second;
}

/// The corner whose neighbourhood must be refined: an irregular one within the zone, else the nearest heavy one.
std::optional<int> OpenSubdivOracle::Implementation::corner_to_refine(const Place& at) {
  const auto& kind = kinds(at.face);
  std::optional<int> nearest;
  for (int c = 0; c < face_corners(); ++c) {
    const bool candidate = kind[c].heavy || (kind[c].irregular && distance(at, c) <= options_.zone);
    if (candidate && (!nearest || distance(at, c) < distance(at, *nearest))) nearest = c;
  }
  return nearest;
}

LimitSample OpenSubdivOracle::Implementation::at_corner(int face, int corner) {
  auto found = limits_.find({face, corner});
  if (found == limits_.end()) {
    found = limits_.emplace(std::pair(face, corner), corner_limit(root_, rules_, face, corner)).first;
  }
  return {found->second.position, found->second.normal, std::nullopt};
}

/// After `level` steps the distance d 2^level lies in (1/2, 1]: in the corner's child, but not in that one's own.
SurfaceValues OpenSubdivOracle::Implementation::by_chain(Chains& chains, const TaggedMesh& mesh, const Place& at,
                                                         int corner) {
  int exponent;
  const double mantissa = std::frexp(distance(at, corner), &exponent);
  const int level = -exponent + (mantissa == 0.5);
  const auto [cu, cv] = corner_position(corner);
  const double u = cu + std::ldexp(at.u - cu, level), v = cv + std::ldexp(at.v - cv, level);
  if (chains.faces > chains.most_faces) chains.by_vertex.clear(), chains.faces = 0;
  const int vertex = mesh.face_vertices[at.face][corner];
  std::unique_ptr<CornerChain>& chain = chains.by_vertex[vertex];
  if (!chain) chain = std::make_unique<CornerChain>(mesh, rules_, vertex, wide_chains_, cache_);
  const std::size_t before = chain->size();
  SurfaceValues values = chain->evaluate(at.face, corner, level, u, v);
  chains.faces += chain->size() - before;
  values.rescale(at.scale);
  return values;
}

/// A corner beside a heavy one starts from the mesh refined once more as a whole. There the heavy vertex is two rings
/// away and its many faces stay out of the corner's chain; else each corner of a large n-gon would drag them along.
SurfaceValues OpenSubdivOracle::Implementation::near_corner(const Place& at, int corner) {
  const CornerKind& kind = kinds(at.face)[corner];
  if (kind.heavy) return by_chain(heavy_, root_, at, corner);
  if (!kind.beside_heavy || distance(at, corner) > 0.5) return by_chain(light_, root_, at, corner);
  if (!finer_) finer_ = refine(root_, rules_);
  const auto [cu, cv] = corner_position(corner);  // the corner's child has the same corner, at the same place
  const Place child{finer_->face_children[at.face][corner], cu + 2 * (at.u - cu), cv + 2 * (at.v - cv), 2 * at.scale};
  return by_chain(finer_light_, finer_->mesh, child, corner);
}

std::optional<LimitSample> OpenSubdivOracle::Implementation::evaluate(const SurfaceParameter& parameter) {
  const Place at = base_.place_of(parameter);
  if (!base_.has_limit[static_cast<std::size_t>(parameter.face)]) return std::nullopt;
  const std::optional<int> corner = corner_to_refine(at);
  if (corner && distance(at, *corner) < std::ldexp(1, -CornerChain::max_level)) return at_corner(at.face, *corner);
  if (corner) return sample_of(near_corner(at, *corner));
  std::unique_ptr<Piece>& piece = pieces_[at.face];
  if (!piece) piece = std::make_unique<Piece>(root_, at.face, rules_, cache_);
  SurfaceValues values = piece->evaluate(at.u, at.v);
  values.rescale(at.scale);
  return sample_of(values);
}

OpenSubdivOracle::OpenSubdivOracle(const ControlMesh& mesh, const std::string& scheme, const OracleOptions& options)
    : Oracle(root_of(mesh, scheme)), implementation_(std::make_unique<Implementation>(root_, options)) {}
OpenSubdivOracle::~OpenSubdivOracle() = default;

bool OpenSubdivOracle::knows(const std::string& scheme) { return schemes.count(scheme) > 0; }

std::optional<LimitSample> OpenSubdivOracle::evaluate(const SurfaceParameter& at) const {
  return implementation_->evaluate(at);
}

}  // namespace shaolin
