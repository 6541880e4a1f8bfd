// What faces share they agree on: points of edges and vertices seen from all their faces, on irregular meshes with
// every kind of feature.
#include <algorithm>
#include <map>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

struct Example {
  std::string name;
  ControlMesh mesh;
  bool smooth;  ///< no tags, no boundary
};

/// Irregular bodies without symmetry; the last ones with creases that decay, darts, corners and a boundary.
template <Scheme S>
std::vector<Example> examples() {
  std::vector<Example> result;
  for (const int n : {3, 5, 8}) result.push_back({"poles " + std::to_string(n), shaken(poles(S::name, n), 0.2), true});
  result.push_back({"torus", shaken(torus(S::name, 4, 5), 0.2), true});
  if (S::face_kind == FaceKind::quad) {
    result.push_back({"pentagons", shaken(prism(5), 0.2), true});
    result.push_back({"triangles", shaken(prism(3), 0.2), true});
    result.push_back({"triangles alone", shaken(poles("loop", 5), 0.2), true});
  }
  ControlMesh creased = shaken(poles(S::name, 5), 0.2);
  const auto rim = creased.face(0);
  creased.sharp_edges = {{rim[0], rim[1], 10}, {rim[1], rim[2], 2.5f}};
  creased.sharp_vertices = {{1, 1.3f}, {rim[2], 10}};
  result.push_back({"creased", creased, false});
  result.push_back({"sheet", shaken(sheet(S::name, 3, 3), 0.2), false});
  return result;
}

/// A patch's side between two points of the surface: corners k and k + 1 of its domain.
struct PatchSide {
  SurfaceParameter patch;
  std::size_t k;
};

/// The point at `along` on a side, exactly on it.
template <Scheme S>
SurfaceParameter on(const PatchSide& side, double along) {
  SurfaceParameter at = side.patch;
  const auto& corners = Domain<S::face_kind>::corners;
  const auto &a = corners[side.k], &b = corners[(side.k + 1) % corners.size()];
  const double rest = 1 - along;
  at.v = a[1] == b[1] ? a[1] : a[1] < b[1] ? along : rest;
  at.u = a[0] == b[0] ? a[0] : a[0] < b[0] ? along : rest;
  return at;
}

template <Scheme S, class Visit>
void for_sides(const SchemeSurface<S>& surface, Visit visit) {
  for (int face = 0; face < surface.face_count(); ++face)
    for (int sub = 0; sub < surface.sub_count(face); ++sub)
      for (std::size_t k = 0; k < Domain<S::face_kind>::corners.size(); ++k) visit(PatchSide{{face, sub, 0, 0}, k});
}

/// Names for the ends of a patch's sides: vertices, middles of edges (both ends in order), centres of faces.
using Place = std::array<int, 3>;

template <Scheme S>
Place place_of(const SchemeSurface<S>& surface, const PatchSide& side) {
  const auto v = surface.control_mesh().face(side.patch.face);
  const auto n = v.size();
  if (!surface.splits_by_corner(side.patch.face)) return {0, v[side.k], 0};
  const auto sub = static_cast<std::size_t>(side.patch.sub);
  const auto middle = [&](std::size_t i) {
    const auto [low, high] = std::minmax(v[i % n], v[(i + 1) % n]);
    return Place{1, low, high};
  };
  switch (side.k) {
    case 0:
      return {0, v[sub], 0};
    case 1:
      return middle(sub);
    case 2:
      return {2, side.patch.face, 0};
    default:
      return middle(sub + n - 1);
  }
}

/// Both patches beside each edge of patches: the second runs the other way.
template <Scheme S>
std::vector<std::pair<PatchSide, PatchSide>> shared_sides(const SchemeSurface<S>& surface) {
  std::map<std::pair<Place, Place>, PatchSide> seen;
  std::vector<std::pair<PatchSide, PatchSide>> result;
  for_sides(surface, [&](const PatchSide& side) {
    const std::size_t next = (side.k + 1) % Domain<S::face_kind>::corners.size();
    const Place a = place_of(surface, side), b = place_of(surface, {side.patch, next});
    if (const auto other = seen.find({b, a}); other != seen.end()) result.emplace_back(other->second, side);
    seen.insert({{a, b}, side});
  });
  return result;
}

/// The derivative along a side's direction.
template <Scheme S>
Vec3 along_side(const PatchSide& side, const Derivatives& d) {
  const auto& corners = Domain<S::face_kind>::corners;
  const auto &a = corners[side.k], &b = corners[(side.k + 1) % corners.size()];
  return (b[0] - a[0]) * d.du + (b[1] - a[1]) * d.dv;
}

/// Dyadic, so that 1 - along is exact: near an irregular vertex derivatives feel a parameter's relative error.
constexpr std::array places{0.5, 0.3125, 0x1p-10, 1 - 0x1p-20, 0x1p-30};

}  // namespace

TEMPLATE_TEST_CASE("Both patches beside an edge agree in position and derivative along it, normals where it is smooth",
                   "[schemes][continuity]", Loop, CatmullClark) {
  using S = TestType;
  for (const Example& example : examples<S>()) {
    const SchemeSurface<S> surface(example.mesh);
    const double diagonal = example.mesh.diagonal();
    const auto pairs = shared_sides(surface);
    CAPTURE(example.name);
    REQUIRE(pairs.size() >= 6);
    for (const auto& [one, other] : pairs)
      for (const double along : places) {
        const LimitSample a = *surface.evaluate(on<S>(one, along)), b = *surface.evaluate(on<S>(other, 1 - along));
        CAPTURE(one.patch.face, one.patch.sub, other.patch.face, other.patch.sub, along);
        CHECK((a.position - b.position).norm() < 1e-13 * diagonal);
        if (example.smooth) CHECK((a.normal - b.normal).norm() < 1e-9);
        REQUIRE((a.derivatives && b.derivatives));
        const Vec3 da = along_side<S>(one, *a.derivatives), db = along_side<S>(other, *b.derivatives);
        CHECK((da + db).norm() < 1e-9 * (diagonal + da.norm()));
      }
  }
}

TEMPLATE_TEST_CASE("Second derivatives go on across the edges of a regular mesh", "[schemes][continuity]", Loop,
                   CatmullClark) {
  // Both schemes' regular splines are C2. The map between the parameters of both sides is affine: p -> J p + c.
  using S = TestType;
  const ControlMesh mesh = shaken(torus(S::name, 6, 7), 0.2);
  const SchemeSurface<S> surface(mesh);
  constexpr bool quads = S::face_kind == FaceKind::quad;
  for (const auto& [one, other] : shared_sides(surface)) {
    const auto& corners = Domain<S::face_kind>::corners;
    const std::size_t n = corners.size();
    const auto corner = [&](const PatchSide& side, std::size_t step) {
      const auto& c = corners[(side.k + step) % n];
      return Parameter(c[0], c[1]);
    };
    // Beyond the side, mirrored in it on quads, in its middle on triangles: where the next corner over there lies.
    const Parameter a = corner(one, 0), b = corner(one, 1);
    const Parameter beyond = quads ? Parameter(2 * a - corner(one, 3)) : Parameter(a + b - corner(one, 2));
    Eigen::Matrix2d from, to;
    from << b - a, beyond - a;
    to << corner(other, 0) - corner(other, 1), corner(other, 2) - corner(other, 1);
    const Eigen::Matrix2d j = to * from.inverse();
    for (const double along : {0.25, 0.5, 0.9}) {
      const Derivatives p = *surface.evaluate(on<S>(one, along))->derivatives;
      const Derivatives q = *surface.evaluate(on<S>(other, 1 - along))->derivatives;
      const auto first = [&](int i) -> Vec3 { return j(0, i) * q.du + j(1, i) * q.dv; };
      const auto second = [&](int i, int k) -> Vec3 {
        return j(0, i) * j(0, k) * q.duu + (j(0, i) * j(1, k) + j(1, i) * j(0, k)) * q.duv + j(1, i) * j(1, k) * q.dvv;
      };
      CAPTURE(one.patch.face, other.patch.face, along);
      CHECK((p.du - first(0)).norm() < 1e-13 * mesh.diagonal());
      CHECK((p.dv - first(1)).norm() < 1e-13 * mesh.diagonal());
      CHECK((p.duu - second(0, 0)).norm() < 1e-12 * mesh.diagonal());
      CHECK((p.duv - second(0, 1)).norm() < 1e-12 * mesh.diagonal());
      CHECK((p.dvv - second(1, 1)).norm() < 1e-12 * mesh.diagonal());
    }
  }
}

TEMPLATE_TEST_CASE("All patches at a vertex agree where it goes, and which way it faces if it is smooth",
                   "[schemes][continuity]", Loop, CatmullClark) {
  using S = TestType;
  for (const Example& example : examples<S>()) {
    const SchemeSurface<S> surface(example.mesh);
    std::map<Place, LimitSample> first;
    int compared = 0;
    for_sides(surface, [&](const PatchSide& side) {
      const LimitSample sample = *surface.evaluate(on<S>(side, 0));
      const auto [at, is_new] = first.insert({place_of(surface, side), sample});
      if (is_new) return;
      ++compared;
      CAPTURE(example.name, side.patch.face, side.patch.sub, side.k);
      CHECK((sample.position - at->second.position).norm() < 1e-14 * example.mesh.diagonal());
      if (example.smooth) CHECK((sample.normal - at->second.normal).norm() < 1e-12);
    });
    CHECK(compared >= surface.face_count());
  }
}

TEST_CASE("Quads and n-gons agree along the edges between them", "[schemes][continuity]") {
  // The n-gon's patches at both ends of an edge each see one half of it, the quad sees all.
  for (const int n : {3, 5, 7}) {
    const ControlMesh mesh = shaken(prism(n), 0.2);
    const SchemeSurface<CatmullClark> surface(mesh);
    for (int i = 0; i < n; ++i) {
      // Quad 2 + i has side 2 from 2 j + 1 to 2 i + 1; in face 1 the edge runs from corner i to corner i + 1.
      for (const double along : {0.0, 0.2, 0.5, 0.7, 1 - 1e-6, 1.0}) {
        const bool near = along <= 0.5;
        const LimitSample quad = *surface.evaluate({2 + i, 0, along, 1});
        const LimitSample gon =
            near ? *surface.evaluate({1, i, 2 * along, 0}) : *surface.evaluate({1, (i + 1) % n, 0, 2 * (1 - along)});
        CAPTURE(n, i, along);
        CHECK((quad.position - gon.position).norm() < 1e-13 * mesh.diagonal());
        CHECK((quad.normal - gon.normal).norm() < 1e-9);
        if (!quad.derivatives || !gon.derivatives) continue;
        const Vec3 seen = near ? gon.derivatives->du * 2 : gon.derivatives->dv * -2;
        CHECK((quad.derivatives->du - seen).norm() < 1e-9 * mesh.diagonal());
      }
    }
  }
}

}  // namespace shaolin
