// Configurations: which are regular, and that descending towards a corner meets a finite number of them.
#include "schemes/configuration.h"

#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

TEMPLATE_TEST_CASE("A torus is regular everywhere, a pole's faces are not", "[schemes][configuration]", Loop,
                   CatmullClark) {
  using S = TestType;
  const SchemeSurface<S> regular(torus(S::name, 5, 7));
  for (int face = 0; face < regular.face_count(); ++face) CHECK(regular.patch(face, 0).is_regular());
  CHECK(regular.mesh().table().size() == 1);
  const SchemeSurface<S> irregular(poles(S::name, 7));
  for (int face = 0; face < irregular.face_count(); ++face) CHECK_FALSE(irregular.patch(face, 0).is_regular());
}

TEMPLATE_TEST_CASE("Boundaries and infinitely sharp creases are regular", "[schemes][configuration]", Loop,
                   CatmullClark) {
  using S = TestType;
  ControlMesh mesh = sheet(S::name, 6, 6);
  for (int i = 0; i < 6; ++i) mesh.sharp_edges.push_back({3 * 7 + i, 3 * 7 + i + 1, 10});
  const SchemeSurface<S> surface(mesh);
  int regular = 0;
  for (int face = 0; face < surface.face_count(); ++face) regular += surface.patch(face, 0).is_regular();
  // A corner of one face is regular. On triangles two of the sheet's corners have two faces, and where the crease meets
  // the boundary there are one face on one side and two on the other.
  CHECK(regular == (S::face_kind == FaceKind::quad ? 36 : 72 - (2 + 2) - (2 + 2)));
}

TEMPLATE_TEST_CASE("The configurations around an irregular corner close", "[schemes][configuration]", Loop,
                   CatmullClark) {
  using S = TestType;
  for (const Model& model : all_models()) {
    if (model.scheme != S::name) continue;
    CAPTURE(model.name);
    const SchemeSurface<S> surface(model.mesh);
    const int stride = 1 + surface.face_count() / 50;
    const auto descend = [&](int levels) {
      for (int face = 0; face < surface.face_count(); face += stride) {
        if (!surface.has_limit(face)) continue;
        for (int sub = 0; sub < surface.sub_count(face); ++sub)
          for (int k = 0; k < Domain<S::face_kind>::corner_count; ++k) {
            const Configuration<S>* at = surface.patch(face, sub).configuration;
            for (int level = 0; level < levels; ++level) at = at->child(k).configuration;
          }
      }
    };
    // Sharpness below 10 is gone after ten levels, rings repeat after a few more.
    descend(14);
    const std::size_t size = surface.mesh().table().size();
    descend(40);
    CHECK(surface.mesh().table().size() == size);
  }
}

}  // namespace shaolin
