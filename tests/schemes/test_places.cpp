// Places that are one point, against evaluation.
#include <algorithm>

#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

bool is_same(const SurfaceParameter& a, const SurfaceParameter& b) {
  return a.face == b.face && a.sub == b.sub && a.u == b.u && a.v == b.v;
}

}  // namespace

TEST_CASE("Places of a point are one point, and know each other", "[schemes][places]") {
  int inside = 0, across = 0, vertices = 0, open = 0;
  for (const Model& model : all_models()) {
    INFO(model.name);
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    const double size = model.mesh.diagonal();
    const int stride = 1 + surface->face_count() / 100;
    for (int face = 0; face < surface->face_count(); face += stride) {
      if (!surface->has_limit(face)) continue;
      for (int sub = 0; sub < surface->sub_count(face); ++sub)
        for (const double u : {0.0, 0.25, 1.0})
          for (const double v : {0.0, 0.375, 0.75, 1.0}) {
            if (surface->triangular() && u + v > 1) continue;
            const SurfaceParameter at{face, sub, u, v};
            const PointPlaces places = surface->places_of(at);
            REQUIRE_FALSE(places.all.empty());
            (places.all.size() == 1 ? inside : places.all.size() == 2 ? across : vertices) += 1;
            open += !places.is_closed;
            const Vec3 point = surface->evaluate(at)->position;
            CHECK(std::any_of(places.all.begin(), places.all.end(),
                              [&](const SurfaceParameter& other) { return is_same(other, at); }));
            for (std::size_t i = 0; i < places.all.size(); ++i) {
              const SurfaceParameter& other = places.all[i];
              CHECK((surface->evaluate(other)->position - point).norm() <= 1e-13 * size);
              const PointPlaces back = surface->places_of(other);
              CHECK(back.all.size() == places.all.size());
              CHECK(back.is_closed == places.is_closed);
              for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(is_same(other, places.all[j]));
            }
          }
    }
  }
  CHECK(inside > 1000);
  CHECK(across > 1000);
  CHECK(vertices > 1000);
  CHECK(open > 100);
}

TEST_CASE("Vertices have as many places as faces", "[schemes][places]") {
  const auto quads = make_limit_surface(torus("catmark", 5, 7), "catmark");
  CHECK(quads->places_of({3, 0, 1, 1}).all.size() == 4);
  CHECK(quads->places_of({3, 0, 0.5, 1}).all.size() == 2);
  CHECK(quads->places_of({3, 0, 0.5, 0.5}).all.size() == 1);
  CHECK(quads->places_of({3, 0, 1, 1}).is_closed);
  CHECK_THROWS_AS(quads->places_of({35, 0, 0, 0}), InputError);
  const auto triangles = make_limit_surface(torus("loop", 5, 7), "loop");
  CHECK(triangles->places_of({3, 0, 0, 1}).all.size() == 6);
  CHECK(triangles->places_of({3, 0, 0.25, 0.75}).all.size() == 2);
}

}  // namespace shaolin
