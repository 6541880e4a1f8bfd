// The oracle against brute force: whole meshes refined by OpenSubdiv's Far, its masks of regular limit points, Bfr
// itself on faces that are n-gons, and finite differences.
#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <random>
#include <string>

#include "schemes/obj.h"
#include "tests/catch.h"
#include "tests/tools/oracle_models.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin::oracle_test {

namespace {
namespace Far = OpenSubdiv::Far;
namespace Bfr = OpenSubdiv::Bfr;
namespace Sdc = OpenSubdiv::Sdc;

Sdc::SchemeType osd_scheme(const std::string& scheme) {
  return scheme == "loop" ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
}

std::unique_ptr<Far::TopologyRefiner> osd_refiner(const ControlMesh& mesh, const std::string& scheme) {
  std::vector<int> sizes, edges, corners;
  std::vector<float> edge_weights, corner_weights;
  for (int f = 0; f < mesh.face_count(); ++f) sizes.push_back(mesh.face_size(f));
  for (const SharpEdge& e : mesh.sharp_edges) {
    edges.insert(edges.end(), {e.a, e.b});
    edge_weights.push_back(e.sharpness);
  }
  for (const SharpVertex& v : mesh.sharp_vertices) corners.push_back(v.vertex), corner_weights.push_back(v.sharpness);
  Far::TopologyDescriptor d;
  d.numVertices = static_cast<int>(mesh.positions.size());
  d.numFaces = mesh.face_count();
  d.numVertsPerFace = sizes.data();
  d.vertIndicesPerFace = mesh.face_vertices.data();
  d.numCreases = static_cast<int>(edge_weights.size());
  d.creaseVertexIndexPairs = edges.data();
  d.creaseWeights = edge_weights.data();
  d.numCorners = static_cast<int>(corners.size());
  d.cornerVertexIndices = corners.data();
  d.cornerWeights = corner_weights.data();
  Sdc::Options options;
  constexpr Sdc::Options::VtxBoundaryInterpolation boundary[] = {Sdc::Options::VTX_BOUNDARY_NONE,
                                                                 Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER,
                                                                 Sdc::Options::VTX_BOUNDARY_EDGE_ONLY};
  options.SetVtxBoundaryInterpolation(boundary[static_cast<int>(mesh.boundary)]);
  if (mesh.crease_method == CreaseMethod::chaikin) options.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
  if (mesh.triangle_subdivision == TriangleSubdivision::smooth) {
    options.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
  }
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(d, Factory::Options(osd_scheme(scheme), options)));
}

struct FarPoint {
  Vec3 p = Vec3::Zero();
  void Clear() { p.setZero(); }
  void AddWithWeight(const FarPoint& other, double weight) { p += weight * other.p; }
};

/// A face of some level in the parameter square of a piece.
struct Cell {
  int face = 0, sub = 0;
  double u = 0, v = 0, size = 1;  // size < 0: turned by half a turn (a triangle's middle child)
};

/// Refines the whole mesh and calls visit(parameter, limit position) for the grid of 2^levels steps of every piece,
/// without the pieces' corners: there the masks may be wrong.
void brute_force(const Model& model, int levels,
                 const std::function<void(const SurfaceParameter&, const Vec3&)>& visit) {
  const auto refiner = osd_refiner(model.mesh, model.scheme);
  Far::TopologyRefiner::UniformOptions uniform(levels);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  std::vector<FarPoint> points(model.mesh.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i].p = model.mesh.positions[i];
  std::vector<Cell> cells(static_cast<std::size_t>(model.mesh.face_count()));
  for (int f = 0; f < model.mesh.face_count(); ++f) cells[f].face = f;
  const bool loop = model.scheme == "loop";
  for (int level = 0; level < levels; ++level) {
    const Far::TopologyLevel& coarse = refiner->GetLevel(level);
    const Far::TopologyLevel& fine = refiner->GetLevel(level + 1);
    std::vector<FarPoint> next(static_cast<std::size_t>(fine.GetNumVertices()));
    Far::PrimvarRefinerReal<double>(*refiner).Interpolate(level + 1, points, next);
    points.swap(next);
    std::vector<Cell> children(static_cast<std::size_t>(fine.GetNumFaces()));
    for (int f = 0; f < coarse.GetNumFaces(); ++f) {
      const auto child = coarse.GetFaceChildFaces(f);
      for (int i = 0; i < child.size(); ++i) {
        Cell cell = cells[f];
        if (!loop && coarse.GetFaceVertices(f).size() != 4) {
          cell.sub = i;  // a whole piece
        } else if (loop && i == 3) {
          cell.size /= -2;
          cell.u -= cell.size, cell.v -= cell.size;
        } else {
          cell.size /= 2;
          cell.u += cell.size * (i == 1 || (i == 2 && !loop)), cell.v += cell.size * (i >= 2);
        }
        children[child[i]] = cell;
      }
    }
    cells.swap(children);
  }
  std::vector<FarPoint> limit(points.size());
  Far::PrimvarRefinerReal<double>(*refiner).Limit(points, limit);
  const Far::TopologyLevel& last = refiner->GetLevel(levels);
  for (int f = 0; f < last.GetNumFaces(); ++f) {
    const Cell& cell = cells[f];
    for (int i = 0; i < last.GetFaceVertices(f).size(); ++i) {
      const SurfaceParameter at{cell.face, cell.sub, cell.u + cell.size * (i == 1 || (i == 2 && !loop)),
                                cell.v + cell.size * (i >= 2)};
      const bool corner = (at.u == 0 || at.u == 1) && (at.v == 0 || at.v == 1);
      if (!corner) visit(at, limit[last.GetFaceVertices(f)[i]].p);
    }
  }
}

double worst_against_brute_force(const Model& model, int levels, const OracleOptions& options) {
  const OpenSubdivOracle oracle(model.mesh, model.scheme, options);
  double worst = 0;
  brute_force(model, levels, [&](const SurfaceParameter& at, const Vec3& expected) {
    if (const auto sample = oracle.evaluate(at)) worst = std::max(worst, (sample->position - expected).norm());
  });
  return worst / oracle.diagonal();
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

TEST_CASE("the oracle gives the limit points of the whole mesh, refined", "[tools][oracle]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    CHECK(worst_against_brute_force(model, 6, {}) <= 1e-12);
  }
  CHECK(worst_against_brute_force({"pillow", "loop", pillow()}, 6, {}) <= 1e-12);
}

TEST_CASE("refinement of a corner's 3-ring alone gives the same limit points", "[tools][oracle][sweep]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    CHECK(worst_against_brute_force(model, 6, {.zone = 1}) <= 1e-12);
    CHECK(worst_against_brute_force(model, 6, {.zone = 0.01, .heavy_valence = 0}) <= 1e-12);
  }
  CHECK(worst_against_brute_force({"pillow", "loop", pillow()}, 6, {.zone = 1}) <= 1e-12);
}

TEST_CASE("close to irregular corners the oracle agrees with nine levels of the whole mesh", "[tools][oracle]") {
  for (const Model& model : {Model{"catmark tetrahedron", "catmark", shaken(tetrahedron(), 0.13)},
                             Model{"loop tetrahedron", "loop", shaken(tetrahedron(), 0.13)}}) {
    INFO(model.name);
    const OpenSubdivOracle oracle(model.mesh, model.scheme);
    double worst = 0;
    int compared = 0;
    brute_force(model, 9, [&](const SurfaceParameter& at, const Vec3& expected) {
      if (at.u > 1.0 / 128 || at.v > 1.0 / 128) return;
      worst = std::max(worst, (oracle.evaluate(at)->position - expected).norm());
      ++compared;
    });
    CHECK(compared > 50);
    CHECK(worst <= 1e-12 * oracle.diagonal());
  }
}

TEST_CASE("the oracle is continuous across the zone that it refines", "[tools][oracle]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    const OpenSubdivOracle refines(model.mesh, model.scheme),
        evaluates_bfr(model.mesh, model.scheme, {.zone = std::ldexp(1, -10)});
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
      SurfaceParameter at = random_parameter(refines, random);
      at.u = std::max(at.u, 0.3);  // between 2^-10 and 2^-8 of a corner
      if (refines.triangular()) at.v = std::min(at.v, 1 - at.u);
      at = towards_corner(at, refines.triangular(), 0, 1.0 / 280);
      const auto a = refines.evaluate(at), b = evaluates_bfr.evaluate(at);
      REQUIRE((a->position - b->position).norm() <= 1e-13 * refines.diagonal());
      REQUIRE(angle_between(a->normal, b->normal) <= 1e-9);
      REQUIRE((a->derivatives->duv - b->derivatives->duv).norm() <=
              1e-7 * (refines.diagonal() + b->derivatives->duv.norm()));
    }
  }
}

TEST_CASE("the oracle's derivatives are those of its positions", "[tools][oracle]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    const OpenSubdivOracle oracle(model.mesh, model.scheme);
    std::mt19937 random(4);
    for (int i = 0; i < 60; ++i) {
      SurfaceParameter at = random_parameter(oracle, random);
      const double factor = i % 3 == 0 ? 1e-4 : 1;
      at.u = 0.1 + 0.38 * at.u, at.v = 0.1 + 0.38 * at.v;
      at = towards_corner(at, oracle.triangular(), i, factor);
      const double h = 1e-5 * factor;
      const auto value = [&](double du, double dv) {
        return *oracle.evaluate({at.face, at.sub, at.u + du * h, at.v + dv * h});
      };
      const Derivatives d = *value(0, 0).derivatives;
      const Vec3 du = (value(1, 0).position - value(-1, 0).position) / (2 * h);
      const Vec3 dv = (value(0, 1).position - value(0, -1).position) / (2 * h);
      const Vec3 duu = (value(1, 0).derivatives->du - value(-1, 0).derivatives->du) / (2 * h);
      const Vec3 duv = (value(0, 1).derivatives->du - value(0, -1).derivatives->du) / (2 * h);
      const Vec3 dvv = (value(0, 1).derivatives->dv - value(0, -1).derivatives->dv) / (2 * h);
      const double first = 1e-6 * oracle.diagonal() / factor, second = first / factor;
      REQUIRE((du - d.du).norm() <= first);
      REQUIRE((dv - d.dv).norm() <= first);
      REQUIRE((duu - d.duu).norm() <= 1e-4 * d.duu.norm() + second);
      REQUIRE((duv - d.duv).norm() <= 1e-4 * d.duv.norm() + second);
      REQUIRE((dvv - d.dvv).norm() <= 1e-4 * d.dvv.norm() + second);
      REQUIRE(angle_between(value(0, 0).normal, d.du.cross(d.dv)) <= 1e-12);
    }
  }
}

TEST_CASE("at a corner the oracle gives the limit of the points around it", "[tools][oracle][sweep]") {
  for (const Model& model : feature_models()) {
    INFO(model.name);
    const OpenSubdivOracle oracle(model.mesh, model.scheme);
    for (int f = 0; f < oracle.face_count(); ++f) {
      for (int sub = 0; oracle.has_limit(f) && sub < oracle.sub_count(f); ++sub) {
        const SurfaceParameter corner{f, sub, 0, 0}, near{f, sub, std::ldexp(0.7, -110), std::ldexp(0.2, -110)};
        const LimitSample limit = *oracle.evaluate(corner), sample = *oracle.evaluate(near);
        REQUIRE((limit.position - sample.position).norm() <= 1e-13 * oracle.diagonal());
      }
    }
  }
}

TEST_CASE("the oracle's normals at corners are limits where there are any", "[tools][oracle][sweep]") {
  int with_normal = 0;
  for (const Model& model : feature_models()) {
    INFO(model.name);
    const OpenSubdivOracle oracle(model.mesh, model.scheme);
    for (int f = 0; f < oracle.face_count(); ++f) {
      if (!oracle.has_limit(f)) continue;
      const LimitSample limit = *oracle.evaluate({f, 0, 0, 0});
      if (limit.normal.isZero()) continue;
      ++with_normal;
      // Normals approach their limit like a power of the distance, at boundary corners of one Catmull-Clark face only
      // like 1 / log2 of it. On one face inside a crease the crease's plane shrinks like the distance's square, so
      // that rounding hides it soon; elsewhere it takes many levels: any of these distances may be the best.
      const bool slow = model.name == "catmark edge only" || model.name == "catmark crease";
      double best = 4;
      for (int exponent : {-15, -20, -27, -50, -100}) {
        const double distance = std::ldexp(1, exponent);
        const LimitSample near = *oracle.evaluate({f, 0, 0.4 * distance, 0.3 * distance});
        best = std::min(best, angle_between(near.normal, limit.normal));
      }
      INFO("face " << f);
      CHECK(best <= (slow ? 0.1 : 1e-6));
    }
  }
  CHECK(with_normal > 50);
}

TEST_CASE("the oracle's parameters on n-gons are Bfr's sub-faces", "[tools][oracle]") {
  const ControlMesh mesh = with_edges(shaken(prism(5), 0.13), {{0, 1, 10}, {1, 3, 1.7f}});
  const OpenSubdivOracle oracle(mesh, "catmark");
  const auto refiner = osd_refiner(mesh, "catmark");
  Bfr::SurfaceFactory::Options options;
  options.SetApproxLevelSmooth(10).SetApproxLevelSharp(10);
  const Bfr::RefinerSurfaceFactory<> factory(*refiner, options);
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const SurfaceParameter at = random_parameter(oracle, random);
    Bfr::Surface<double> surface;
    REQUIRE(factory.InitVertexSurface(at.face, &surface));
    std::vector<double> points(static_cast<std::size_t>(3 * surface.GetNumPatchPoints()));
    surface.PreparePatchPoints(mesh.positions.front().data(), 3, points.data(), 3);
    const Bfr::Parameterization parameterization = surface.GetParameterization();
    double uv[2] = {at.u, at.v};
    double scale = 1;
    if (parameterization.HasSubFaces()) {
      const double normalized[2] = {at.u, at.v};
      parameterization.ConvertNormalizedSubFaceToCoord(at.sub, normalized, uv);
      scale = 0.5;  // a sub-face spans half a unit of Bfr's parameter
    }
    Vec3 p, du, dv, duu, duv, dvv;
    surface.Evaluate(uv, points.data(), 3, p.data(), du.data(), dv.data(), duu.data(), duv.data(), dvv.data());
    const LimitSample sample = *oracle.evaluate(at);
    REQUIRE((sample.position - p).norm() <= 1e-13);
    REQUIRE((sample.derivatives->du - scale * du).norm() <= 1e-11);
    REQUIRE((sample.derivatives->dv - scale * dv).norm() <= 1e-11);
    REQUIRE((sample.derivatives->duv - scale * scale * duv).norm() <= 1e-8 * (1 + duv.norm()));
  }
}

TEST_CASE("high valence costs the oracle moderate time and no accuracy", "[tools][oracle][sweep]") {
  for (const std::string scheme : {"catmark", "loop"}) {
    INFO(scheme);
    const Model model{scheme, scheme, shaken(poles("loop", 360), 0.13)};
    CHECK(worst_against_brute_force(model, 3, {}) <= 1e-12);
    const OpenSubdivOracle oracle(model.mesh, scheme);
    // The pole is corner 0; along an edge the surface is the limit of what is between.
    const auto at = [](double d) { return SurfaceParameter{0, 0, d / 3, d}; };
    const LimitSample pole = *oracle.evaluate(at(0));
    CHECK_FALSE(pole.derivatives);
    CHECK((oracle.evaluate(at(1e-12))->position - pole.position).norm() <= 1e-5);
    CHECK((oracle.evaluate(at(std::ldexp(1, -50)))->position - pole.position).norm() <= 1e-8);
  }
}

TEST_CASE("faces without a limit surface give no sample", "[tools][oracle]") {
  ControlMesh open = with_boundary(shaken(sheet("catmark", 4, 4), 0.13), BoundaryInterpolation::none);
  open.holes = {5};
  const OpenSubdivOracle oracle(open, "catmark");
  int with_limit = 0;
  for (int f = 0; f < oracle.face_count(); ++f) {
    CHECK(oracle.evaluate({f, 0, 0.5, 0.5}).has_value() == oracle.has_limit(f));
    with_limit += oracle.has_limit(f);
  }
  CHECK(with_limit == 3);  // the inner 2 x 2 without the hole
  CHECK_THROWS(oracle.evaluate({0, 1, 0.5, 0.5}));
  CHECK_THROWS(oracle.evaluate({99, 0, 0.5, 0.5}));
}

/// Enough levels for semi-sharp tags to decay; at least four.
int levels_for(const ControlMesh& mesh) {
  float sharpest = 3;
  for (const SharpEdge& edge : mesh.sharp_edges) {
    if (edge.sharpness < infinite_sharpness) sharpest = std::max(sharpest, edge.sharpness);
  }
  for (const SharpVertex& vertex : mesh.sharp_vertices) {
    if (vertex.sharpness < infinite_sharpness) sharpest = std::max(sharpest, vertex.sharpness);
  }
  return static_cast<int>(std::ceil(sharpest)) + 1;
}

void compare_both_ways(const Model& model) {
  const OpenSubdivOracle bfr(model.mesh, model.scheme),
      refined(model.mesh, model.scheme, {.zone = 0.3, .heavy_valence = 6});
  std::mt19937 random(6);
  for (int i = 0; i < 300; ++i) {
    SurfaceParameter at = random_parameter(bfr, random);
    if (i % 4 == 0) at = towards_corner(at, bfr.triangular(), i / 4, std::pow(10, -8.0 * (i % 97) / 97));
    INFO("face " << at.face << " sub " << at.sub << " u " << at.u << " v " << at.v);
    const LimitSample a = *bfr.evaluate(at), b = *refined.evaluate(at);
    REQUIRE((a.position - b.position).norm() <= 1e-12 * bfr.diagonal());
    if (!a.normal.isZero() && !b.normal.isZero()) REQUIRE(angle_between(a.normal, b.normal) <= 1e-7);
  }
}

TEST_CASE("the oracle is exact on the shapes in SHAOLIN_SHAPES", "[tools][oracle][sweep]") {
  const char* folder = std::getenv("SHAOLIN_SHAPES");
  if (folder == nullptr) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().stem();
    INFO(name);
    Model model{name, "catmark", {}};
    try {
      model.mesh = read_obj(entry.path());
    } catch (const std::exception& error) {
      WARN(error.what());
      continue;
    }
    if (name.starts_with("loop_") || name.ends_with("_loop")) model.scheme = "loop";
    compare_both_ways(model);
    const int levels = levels_for(model.mesh);
    if (model.mesh.face_count() << (2 * levels) < 400000) CHECK(worst_against_brute_force(model, levels, {}) <= 1e-12);
  }
}

}  // namespace shaolin::oracle_test
