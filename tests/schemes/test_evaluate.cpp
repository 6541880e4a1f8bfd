// Evaluation against refinement, against itself across shared edges, and against differences, down to the corners.
#include "schemes/evaluate.h"

#include <cmath>

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/random_patches.h"

namespace shaolin {

namespace {

/// Calls use(surface, face, sub) for up to about `most` patches of every model of the scheme.
template <Scheme S, class Use>
void for_patches_of_models(int most, Use use) {
  for (const Model& model : all_models()) {
    if (model.scheme != S::name) continue;
    const SchemeSurface<S> surface(model.mesh);
    const int stride = 1 + surface.face_count() / most;
    for (int face = 0; face < surface.face_count(); face += stride) {
      if (!surface.has_limit(face)) continue;
      INFO(model.name << " face " << face);
      for (int sub = 0; sub < surface.sub_count(face); ++sub) use(surface, face, sub);
    }
  }
}

/// A corner's limit by nothing but masks of refinement: its control point after many levels.
template <Scheme S>
Vec3 refined_corner(Patch<S> patch, int corner, int levels) {
  for (int level = 0; level < levels; ++level) patch = patch.child(corner);
  return patch.points[static_cast<std::size_t>(corner)];
}

}  // namespace

TEMPLATE_TEST_CASE("Corner limits are those of deep refinement", "[schemes][evaluate]", Loop, CatmullClark) {
  using S = TestType;
  for_patches_of_models<S>(200, [](const SchemeSurface<S>& surface, int face, int sub) {
    const Patch<S> patch = surface.patch(face, sub);
    const double diagonal = surface.control_mesh().diagonal();
    for (int k = 0; k < Domain<S::face_kind>::corner_count; ++k) {
      const Parameter at = detail::corner_parameter<S>(k);
      const Vec3 limit = surface.evaluate({face, sub, at.x(), at.y()})->position;
      CAPTURE(sub, k);
      CHECK((limit - refined_corner(patch, k, 100)).norm() < 1e-13 * diagonal);
    }
  });
}

TEMPLATE_TEST_CASE("To refine and then evaluate is to evaluate", "[schemes][evaluate]", Loop, CatmullClark) {
  using S = TestType;
  using D = Domain<S::face_kind>;
  Random random(2);
  for_patches_of_models<S>(60, [&](const SchemeSurface<S>& surface, int face, int sub) {
    const Patch<S> patch = surface.patch(face, sub);
    const double diagonal = surface.control_mesh().diagonal();
    for (int k = 0; k < 4; ++k) {
      const Parameter at = random_parameter<Domain<S::face_kind>>(random);
      const LimitSample fine = evaluate(patch.child(k), at), coarse = evaluate(patch, D::to_parent(k, at));
      const double s = D::scale(k);
      CAPTURE(sub, k, at.x(), at.y());
      CHECK((fine.position - coarse.position).norm() < 1e-14 * diagonal);
      CHECK((fine.normal - coarse.normal).norm() < 1e-11);
      REQUIRE((fine.derivatives && coarse.derivatives));
      const Vec3 &du = coarse.derivatives->du, &dv = coarse.derivatives->dv;
      CHECK((fine.derivatives->du - s * du).norm() < 1e-12 * (diagonal + du.norm()));
      CHECK((fine.derivatives->dv - s * dv).norm() < 1e-12 * (diagonal + dv.norm()));
    }
  });
}

TEMPLATE_TEST_CASE("Derivatives are limits of differences", "[schemes][evaluate]", Loop, CatmullClark) {
  using S = TestType;
  Random random(3);
  for_patches_of_models<S>(40, [&](const SchemeSurface<S>& surface, int face, int sub) {
    // Inside one polynomial piece: a central difference of a polynomial this low errs by h^2 only.
    constexpr double h = 0x1p-12;
    const Parameter at{0.25 + 0.03 * random.uniform() + 2 * h, 0.25 + 0.1 + 0.03 * random.uniform()};
    const auto sample = [&](double u, double v) { return *surface.evaluate({face, sub, at.x() + u, at.y() + v}); };
    const LimitSample s = sample(0, 0);
    REQUIRE(s.derivatives);
    const Derivatives& d = *s.derivatives;
    const double size = surface.control_mesh().diagonal();
    CAPTURE(sub, at.x(), at.y());
    CHECK(((sample(h, 0).position - sample(-h, 0).position) / (2 * h) - d.du).norm() < 1e-4 * size);
    CHECK(((sample(0, h).position - sample(0, -h).position) / (2 * h) - d.dv).norm() < 1e-4 * size);
    CHECK(((sample(h, 0).derivatives->du - sample(-h, 0).derivatives->du) / (2 * h) - d.duu).norm() < 1e-2 * size);
    CHECK(((sample(0, h).derivatives->du - sample(0, -h).derivatives->du) / (2 * h) - d.duv).norm() < 1e-2 * size);
    CHECK(((sample(0, h).derivatives->dv - sample(0, -h).derivatives->dv) / (2 * h) - d.dvv).norm() < 1e-2 * size);
    const Vec3 normal = d.du.cross(d.dv);
    if (normal.norm() > 1e-9 * size * size) CHECK((s.normal - normal.normalized()).norm() < 1e-6);
  });
}

TEST_CASE("u follows a quad's outgoing edge, v the incoming one; subs begin at the n-gon's corners",
          "[schemes][evaluate]") {
  ControlMesh mesh = prism(5);
  for (int i = 0; i < 5; ++i) {  // all edges sharp, all corners too: limit edges are the control edges
    const int j = (i + 1) % 5;
    mesh.sharp_edges.push_back({2 * i, 2 * j, 10});
    mesh.sharp_edges.push_back({2 * i + 1, 2 * j + 1, 10});
    mesh.sharp_edges.push_back({2 * i, 2 * i + 1, 10});
  }
  const auto surface = make_limit_surface(mesh, "catmark");
  for (int face = 0; face < mesh.face_count(); ++face) {
    const auto v = mesh.face(face);
    const int n = static_cast<int>(v.size());
    const bool by_corner = n != 4;
    REQUIRE(surface->sub_count(face) == (by_corner ? n : 1));
    const auto corner = [&](int i) -> const Vec3& {
      return mesh.positions[static_cast<std::size_t>(v[static_cast<std::size_t>((i + n) % n)])];
    };
    for (int sub = 0; sub < surface->sub_count(face); ++sub) {
      const double half = by_corner ? 0.5 : 1;
      const auto at = [&](double x, double y) { return surface->evaluate({face, sub, x, y})->position; };
      CAPTURE(face, sub);
      CHECK((at(0, 0) - corner(sub)).norm() < 1e-15);
      CHECK((at(1, 0) - (corner(sub) + half * (corner(sub + 1) - corner(sub)))).norm() < 1e-15);
      CHECK((at(0, 1) - (corner(sub) + half * (corner(sub - 1) - corner(sub)))).norm() < 1e-15);
    }
  }
}

TEMPLATE_TEST_CASE("Normals near a pole keep their digits at any distance", "[schemes][evaluate]", Loop, CatmullClark) {
  using S = TestType;
  for (const int n : {3, 4, 5, 7, 9}) {
    const auto surface = make_limit_surface(shaken(poles(S::name, n), 0.1), S::name);
    const LimitSample corner = *surface->evaluate({0, 0, 0, 0});
    CHECK(corner.derivatives.has_value() == (n == S::regular_valence));
    // The normal tends to the corner's: what is left at one distance bounds it at every smaller one.
    double bound = 2;
    for (const double distance : {1e-4, 1e-8, 1e-12, 1e-15, 1e-20, 1e-40, 1e-100, 1e-300}) {
      const LimitSample near = *surface->evaluate({0, 0, distance, distance / 2});
      const double angle = (near.normal - corner.normal).norm();
      CAPTURE(n, distance, angle);
      CHECK(near.position.allFinite());
      CHECK(std::abs(near.normal.norm() - 1) < 1e-14);
      CHECK(angle <= bound + 1e-12);
      bound = angle;
    }
  }
}

TEST_CASE("A parameter that rounding put outside a triangle evaluates at its edge", "[schemes][evaluate]") {
  // 1 + 1e-20 rounds to 1; the descent towards corner 1 never ended.
  const auto surface = make_limit_surface(poles("loop", 3), "loop");
  const Vec3 corner = surface->evaluate({0, 0, 1, 0})->position;
  CHECK((surface->evaluate({0, 0, 1, 1e-20})->position - corner).norm() < 1e-15);
  CHECK((surface->evaluate({0, 0, 1e-20, 1})->position - surface->evaluate({0, 0, 0, 1})->position).norm() < 1e-15);
}

TEST_CASE("An n-gon of 10,000 sides evaluates", "[schemes][evaluate]") {
  constexpr int n = 10000, turn = 2500;
  const auto surface = make_limit_surface(prism(n), "catmark");
  const LimitSample centre = *surface->evaluate({1, 0, 1, 1});
  CHECK(centre.position.head<2>().norm() < 1e-12);
  CHECK((centre.normal - Vec3::UnitZ()).norm() < 1e-9);
  // A quarter of its corners on, the surface has made a quarter turn.
  const LimitSample here = *surface->evaluate({1, 0, 0.25, 0.5}), there = *surface->evaluate({1, turn, 0.25, 0.5});
  const auto turned = [](const Vec3& p) { return Vec3(-p.y(), p.x(), p.z()); };
  CHECK((there.position - turned(here.position)).norm() < 1e-14);
  CHECK((there.normal - turned(here.normal)).norm() < 1e-12);
  CHECK((there.derivatives->du - turned(here.derivatives->du)).norm() < 1e-12);
}

TEMPLATE_TEST_CASE("Vertices of valence 360 and 10,000 evaluate", "[schemes][evaluate]", Loop, CatmullClark) {
  using S = TestType;
  for (const int n : {360, 10000}) {
    const auto surface = make_limit_surface(poles(S::name, n), S::name);
    const LimitSample pole = *surface->evaluate({0, 0, 0, 0});
    CAPTURE(n);
    CHECK(pole.position.head<2>().norm() < 1e-13);
    CHECK((pole.normal - Vec3::UnitZ()).norm() < 1e-9);
    CHECK((surface->evaluate({0, 0, 1e-9, 0})->position - pole.position).norm() < 0.1);
  }
}

TEST_CASE("A face's own patch evaluates as the surface does", "[schemes][evaluate]") {
  int places = 0;
  for (const Model& model : all_models()) {
    INFO(model.name);
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    for (int face = 0; face < surface->face_count(); face += 1 + surface->face_count() / 50)
      for (int sub = 0; sub < surface->sub_count(face); ++sub) {
        const auto patch = surface->limit_patch(face, sub);
        REQUIRE((patch != nullptr) == surface->has_limit(face));
        if (!patch) continue;
        for (const Parameter& at : {Parameter(0, 0), Parameter(0.3, 0.45), Parameter(1e-5, 0), Parameter(0, 1)}) {
          const LimitSample sample = patch->evaluate(at.x(), at.y());
          const LimitSample expected = *surface->evaluate({face, sub, at.x(), at.y()});
          CHECK(sample.position == expected.position);
          CHECK(sample.normal == expected.normal);
          REQUIRE(sample.derivatives.has_value() == expected.derivatives.has_value());
          if (sample.derivatives) CHECK(sample.derivatives->duv == expected.derivatives->duv);
          ++places;
        }
        CHECK_THROWS_AS(patch->evaluate(1.5, 0), InputError);
      }
    CHECK_THROWS_AS(surface->limit_patch(surface->face_count()), InputError);
  }
  CHECK(places > 1000);
}

}  // namespace shaolin
