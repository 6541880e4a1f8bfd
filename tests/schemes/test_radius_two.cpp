// Schemes of radius 2 without polynomials, the butterfly and Kobbelt's: two ways to refine, limits, bounds, rays.
#include "intersect/limit_bounds.h"
#include "intersect/scene.h"
#include "schemes/load_plugin.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/plugins/plugin_files.h"
#include "tests/random.h"
#include "tools/conformance/conformance.h"

namespace shaolin {

namespace {

template <FaceKind kind>
RuntimeScheme<kind> example() {
  return RuntimeScheme<kind>(
      load_plugin(test::example_plugin(kind == FaceKind::triangle ? "butterfly" : "kobbelt")).masks);
}

/// Models that the split takes, and whose levels half-edges can hold.
template <FaceKind kind>
std::vector<const Model*> models() {
  std::vector<const Model*> result;
  for (const Model& model : all_models())
    if ((model.scheme == "loop") == (kind == FaceKind::triangle) && model.name.find("loop_val2") == std::string::npos)
      result.push_back(&model);
  return result;
}

/// The largest distance between corners of the patches below `face` and those of the refined meshes.
template <Scheme S>
double distance(const SubdivisionMesh<S>& mesh, int face, const Patch<S>& patch,
                const std::vector<const SubdivisionMesh<S>*>& finer, std::size_t level) {
  double largest = 0;
  for (int i = 0; i < mesh.face_size(face); ++i) {
    const Vec3& expected = mesh.point(mesh.face(face)[static_cast<std::size_t>(i)]);
    largest = std::max(largest, (patch.points[static_cast<std::size_t>(i)] - expected).norm());
  }
  if (level == finer.size()) return largest;
  const std::vector<Patch<S>> children = patch.children();
  for (int k = 0; k < mesh.child_count(face); ++k) {
    const Patch<S>& child = children[static_cast<std::size_t>(k)];
    CHECK(child.points == patch.child(k).points);
    largest = std::max(largest, distance(*finer[level], mesh.child_face(face, k), child, finer, level + 1));
  }
  return largest;
}

template <FaceKind kind>
void check_refinement() {
  for (const Model* model : models<kind>()) {
    CAPTURE(model->name);
    const SubdivisionMesh<RuntimeScheme<kind>> mesh(model->mesh, example<kind>());
    const auto first = mesh.refine(), second = first->refine();
    double size = 0, largest = 0;
    for (const Vec3& p : model->mesh.positions) size = std::max(size, p.cwiseAbs().maxCoeff());
    const int stride = 1 + mesh.face_count() / 60;
    for (int face = 0; face < mesh.face_count(); face += stride)
      largest = std::max(largest, distance(mesh, face, mesh.patch({face, 0}), {first.get(), second.get()}, 0));
    CHECK(largest <= 1e-14 * size);
  }
}

template <FaceKind kind>
void check_evaluation() {
  for (const Model* model : models<kind>()) {
    if (model->mesh.face_count() > 100) continue;
    CAPTURE(model->name);
    const SchemeSurface<RuntimeScheme<kind>> surface(model->mesh, example<kind>());
    const auto fine = surface.mesh().refine();
    double size = 0, largest = 0;
    for (const Vec3& p : model->mesh.positions) size = std::max(size, p.cwiseAbs().maxCoeff());
    const int stride = 1 + model->mesh.face_count() / 20;
    for (int face = 0; face < model->mesh.face_count(); face += stride) {
      if (!surface.has_limit(face) || surface.splits_by_corner(face)) continue;
      for (int k = 0; k < 4; ++k) {
        const int child = surface.mesh().child_face(face, k);
        const Parameter at = Domain<kind>::to_parent(k, Parameter::Zero());
        const Vec3 expected = fine->limit_point(fine->face(child)[0]);
        largest = std::max(largest, (surface.evaluate({face, 0, at.x(), at.y()})->position - expected).norm());
      }
    }
    CHECK(largest <= 1e-12 * size);
  }
}

template <FaceKind kind>
void check_rays(int most_faces) {
  for (const Model* model : models<kind>()) {
    if (model->mesh.face_count() > most_faces) continue;
    CAPTURE(model->name);
    const Scene scene(model->mesh, example<kind>().masks);
    const LimitSurface& surface = scene.surface();
    const double diagonal = (scene.bounds().upper - scene.bounds().lower).norm();
    Random random(11);
    int aimed = 0;
    for (int i = 0; i < 60; ++i) {
      const int face = random.index(model->mesh.face_count());
      if (!surface.has_limit(face)) continue;
      double u = random.uniform(), v = random.uniform();
      if (i % 4 == 0) u = std::round(2 * u) / 2, v = std::round(2 * v) / 2;  // edges and vertices of patches
      if (surface.triangular() && u + v > 1) u = 1 - u, v = 1 - v;
      const auto sample = surface.evaluate({face, random.index(surface.sub_count(face)), u, v});
      Ray ray;
      ray.direction = Vec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5}.normalized();
      if (std::abs(ray.direction.dot(sample->normal)) < 0.05) continue;  // grazing rays: the distance is less certain
      ray.origin = sample->position - diagonal * ray.direction;
      const auto hit = scene.intersect(ray);
      CAPTURE(face, u, v);
      REQUIRE(hit);
      CHECK(hit->t <= diagonal * (1 + 1e-11));
      CHECK((ray.origin + hit->t * ray.direction - hit->sample.position).norm() <= 1e-11 * diagonal);
      CHECK(scene.occluded(ray));
      ++aimed;
    }
    CHECK((aimed > 0 || model->mesh.face_count() < 3));
  }
}

/// The largest sum of |phi_i| over a grid on a patch, for the limit functions of its points.
template <Scheme S>
double sampled_bound(Patch<S> patch) {
  constexpr int steps = 8;
  double largest = 0;
  std::vector<double> sums(static_cast<std::size_t>((steps + 1) * (steps + 1)), 0);
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    for (Vec3& p : patch.points) p.setZero();
    patch.points[i].x() = 1;
    for (int a = 0; a <= steps; ++a)
      for (int b = 0; b <= steps; ++b) {
        const Parameter at(static_cast<double>(a) / steps, static_cast<double>(b) / steps);
        if (!Domain<S::face_kind>::contains(at)) continue;
        double& sum = sums[static_cast<std::size_t>(a * (steps + 1) + b)];
        sum += std::abs(evaluate(patch, at).position.x());
        largest = std::max(largest, sum);
      }
  }
  return largest;
}

template <FaceKind kind>
void check_bounds() {
  for (const int n : {3, 4, 5, 6, 7, 12}) {
    CAPTURE(n);
    const ControlMesh mesh = poles(kind == FaceKind::triangle ? "loop" : "catmark", n);
    const SubdivisionMesh<RuntimeScheme<kind>> control(mesh, example<kind>());
    auto patch = control.patch({0, 0});
    for (int level = 0; level < 3; ++level) patch = patch.child(0);
    const double proven = 1 + 2 * patch.configuration->hull_expansion(), seen = sampled_bound(patch);
    CHECK(seen > 1.1);
    CHECK(proven >= seen);
    CHECK(proven <= 4 * seen);
    const auto away = patch.child(2).child(2);
    CHECK(away.configuration->flat_net().has_value());
  }
}

}  // namespace

TEST_CASE("Radius 2: hierarchy and patch give the same points", "[schemes][radius2]") {
  SECTION("butterfly") { check_refinement<FaceKind::triangle>(); }
  SECTION("kobbelt") { check_refinement<FaceKind::quad>(); }
}

TEST_CASE("Radius 2: evaluation gives the limit points of the refined mesh", "[schemes][radius2]") {
  SECTION("butterfly") { check_evaluation<FaceKind::triangle>(); }
  SECTION("kobbelt") { check_evaluation<FaceKind::quad>(); }
}

TEST_CASE("Radius 2: rays at the surface meet it", "[intersect][radius2][sweep]") {
  SECTION("butterfly") { check_rays<FaceKind::triangle>(8); }
  SECTION("kobbelt") { check_rays<FaceKind::quad>(8); }
}

TEST_CASE("Radius 2: rays at the surfaces of larger models meet them", "[intersect][radius2][sweep]") {
  SECTION("butterfly") { check_rays<FaceKind::triangle>(100); }
  SECTION("kobbelt") { check_rays<FaceKind::quad>(100); }
}

TEST_CASE("Radius 2: limit functions stay within their proven bound", "[schemes][radius2]") {
  SECTION("butterfly") { check_bounds<FaceKind::triangle>(); }
  SECTION("kobbelt") { check_bounds<FaceKind::quad>(); }
}

TEST_CASE("Interpolating schemes keep their smooth vertices", "[schemes][radius2]") {
  const ControlMesh mesh = shaken(poles("loop", 7), 0.2);
  const SubdivisionMesh<RuntimeScheme<FaceKind::triangle>> surface(mesh, example<FaceKind::triangle>());
  for (const int v : surface.vertices()) CHECK((surface.limit_point(v) - surface.point(v)).norm() < 1e-13);
}

TEST_CASE("A ring continued across a crease keeps planes", "[schemes][radius2]") {
  // A flat half-star and the whole one: mirror images are where the other half's points are.
  for (const int k : {2, 3, 4, 5}) {
    CAPTURE(k);
    ControlMesh half;
    half.positions.emplace_back(0, 0, 0);
    for (int i = 0; i <= k; ++i)
      half.positions.emplace_back(std::cos(std::numbers::pi * i / k), std::sin(std::numbers::pi * i / k), 0);
    for (int i = 0; i < k; ++i) {
      const std::vector<int> corners{0, 1 + i, 2 + i};
      half.add_face(corners);
    }
    half.boundary = BoundaryInterpolation::edge_only;
    const SubdivisionMesh<RuntimeScheme<FaceKind::triangle>> mesh(half, example<FaceKind::triangle>());
    const Ring ring = mesh.ring(mesh.corner_at(0));
    const ClosedRing closed = ClosedRing::at_spoke(ring, 1);
    CHECK(closed.valence() == 2 * k);
    RingMask mask{0, std::vector<double>(static_cast<std::size_t>(2 * k), 0), {}};
    for (int i = 0; i < 2 * k; ++i) {
      std::fill(mask.edges.begin(), mask.edges.end(), 0);
      mask.edges[static_cast<std::size_t>(i)] = 1;
      Stencil stencil;
      closed.add_to(stencil, mask);
      const double angle = std::numbers::pi * (i + 1) / k;
      CHECK((stencil.of(mesh.points().data()) - Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-14);
    }
  }
}

TEST_CASE("The examples pass the kit, the toy does not", "[tools][conformance][radius2][sweep]") {
  for (const char* name : {"butterfly", "kobbelt"}) {
    const ConformanceReport report = check_conformance(name, load_plugin(test::example_plugin(name)).masks);
    for (const CheckResult& check : report.checks) {
      CAPTURE(name, check.name, check.subject, check.figure, check.note);
      CHECK(check.verdict != Verdict::fail);
    }
    CHECK(report.maps.size() == 10);
  }
  const ConformanceReport toy = check_conformance("toy", load_plugin(test::example_plugin("toy")).masks);
  CHECK_FALSE(toy.passed());
  const auto failed = [&](const std::string& name) {
    return std::any_of(toy.checks.begin(), toy.checks.end(),
                       [&](const CheckResult& check) { return check.name == name && check.verdict == Verdict::fail; });
  };
  CHECK(failed("weights sum to one"));
  CHECK(failed("mean mode"));
}

}  // namespace shaolin
