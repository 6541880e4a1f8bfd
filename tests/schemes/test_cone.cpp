// Conical vertices: the limit near one is a cone, not a plane, under every refinement path alike.
#include <cmath>
#include <numbers>

#include "intersect/scene.h"
#include "schemes/builtin.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/schemes/local_matrix.h"

namespace shaolin {

namespace {

ControlMesh with_cone(ControlMesh mesh) {
  mesh.cones = {0};
  return mesh;
}

/// The first Fourier mode's eigenvalue, in the literature's closed forms.
double first_mode_eigenvalue(FaceKind kind, int n) {
  const double c = std::cos(2 * std::numbers::pi / n);
  return kind == FaceKind::triangle ? 3.0 / 8 + c / 4
                                    : (5 + c + std::cos(std::numbers::pi / n) * std::sqrt(18 + 2 * c)) / 16;
}

}  // namespace

TEMPLATE_TEST_CASE("A cone's mean mode shrinks as its first Fourier mode does", "[schemes][cone]", Loop, CatmullClark) {
  using S = TestType;
  for (const int n : {3, 4, 5, 6, 7, 12, 40}) {
    CAPTURE(n);
    const VertexMask mask = S::cone_vertex(n);
    CHECK(std::abs(mask.vertex + n * (mask.edge + mask.face) - 1) < 1e-14);
    CHECK(mask.vertex > 0);
    CHECK(mask.edge > 0);
    const LocalMatrix local = local_matrix<S>(with_cone(poles(S::name, n)));
    // Eigenvalue 1, then three of the same modulus: the mean mode and both of the first Fourier mode.
    std::vector<double> moduli;
    for (const auto& value : eigenvalues(local.matrix)) moduli.push_back(std::abs(value));
    std::sort(moduli.rbegin(), moduli.rend());
    CHECK(moduli[0] == Approx(1).epsilon(1e-12));
    for (const int i : {1, 2, 3})
      CHECK(moduli[static_cast<std::size_t>(i)] == Approx(first_mode_eigenvalue(S::face_kind, n)).epsilon(1e-7));
    for (std::size_t i = 4; i < moduli.size(); ++i) CHECK(moduli[i] < moduli[3] * (1 - 1e-4));
  }
}

TEMPLATE_TEST_CASE("Near a conical vertex the surface is a cone", "[schemes][cone]", Loop, CatmullClark) {
  using S = TestType;
  for (const int n : {3, 4, 5, 6, 9}) {
    CAPTURE(n);
    const ControlMesh mesh = poles(S::name, n);
    const auto smooth = make_limit_surface(mesh, S::name), cone = make_limit_surface(with_cone(mesh), S::name);
    const double lambda = first_mode_eigenvalue(S::face_kind, n);
    const auto slope = [](const LimitSurface& surface, double t) {
      const Vec3 away = surface.evaluate({0, 0, t, t / 2})->position - surface.evaluate({0, 0, 0, 0})->position;
      return -away.z() / away.head<2>().norm();
    };
    // On its way to the vertex the slope of a smooth cap vanishes, that of a cone settles.
    CHECK(slope(*smooth, 0x1p-20) < 0.05);
    const double far = slope(*cone, 0x1p-15), near = slope(*cone, 0x1p-16);
    CHECK(far > 0.1);
    CHECK(near == Approx(far).epsilon(1e-3));
    const Vec3 apex = cone->evaluate({0, 0, 0, 0})->position;
    const double once = (cone->evaluate({0, 0, 0x1p-20, 0})->position - apex).norm();
    const double twice = (cone->evaluate({0, 0, 0x1p-21, 0})->position - apex).norm();
    CHECK(twice / once == Approx(lambda).epsilon(1e-3));
    // Each face has its own normal at the apex: the one that it approaches.
    const auto at_apex = cone->evaluate({0, 0, 0, 0});
    CHECK(!at_apex->derivatives);
    CHECK(at_apex->normal.norm() == Approx(1));
    CHECK(at_apex->normal.z() < 0.999);
    CHECK((at_apex->normal - cone->evaluate({1, 0, 0, 0})->normal).norm() < 2);
  }
}

TEMPLATE_TEST_CASE("Hierarchy and patch agree on a cone", "[schemes][cone]", Loop, CatmullClark) {
  using S = TestType;
  const SubdivisionMesh<S> mesh(with_cone(shaken(poles(S::name, 5), 0.2)));
  const auto fine = mesh.refine();
  const auto finer = fine->refine();
  const Patch<S> patch = mesh.patch({0, 0}).child(0).child(0);
  CHECK(finer->is_cone(0));
  const Patch<S> same = finer->patch({finer->parent()->child_face(fine->parent()->child_face(0, 0), 0), 0});
  CHECK(same.configuration == patch.configuration);
  CHECK(same.points == patch.points);
}

TEST_CASE("Rays hit a cone at its apex, and a cone tag leaves creases and corners as they are", "[schemes][cone]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    const ControlMesh mesh = with_cone(poles(scheme, 6));
    const Scene scene(mesh, scheme);
    const Vec3 apex = scene.surface().evaluate({0, 0, 0, 0})->position;
    for (const Vec3& from : {Vec3(0, 0, 3), Vec3(1, 0.5, 2)}) {
      Ray ray;
      ray.origin = apex + from;
      ray.direction = -from;
      const auto hit = scene.intersect(ray);
      REQUIRE(hit);
      CHECK(hit->t == Approx(1).epsilon(1e-12));
    }
    ControlMesh corner = poles(scheme, 6);
    corner.sharp_vertices.push_back({0, 10});
    const auto plain = make_limit_surface(corner, scheme), tagged = make_limit_surface(with_cone(corner), scheme);
    CHECK(plain->evaluate({0, 0, 0.1, 0.2})->position == tagged->evaluate({0, 0, 0.1, 0.2})->position);
  }
}

}  // namespace shaolin
