// The polynomials that a face's tree consists of against the limit by repeated splitting.
#include "intersect/parts.h"

#include "schemes/catmull_clark.h"
#include "schemes/evaluate.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/random_patches.h"

namespace shaolin {

namespace {

struct Compared {
  double worst = 0;  ///< of positions
  int polynomials = 0;
  double area = 0;  ///< of the domains, by leaves and what is not split further here
};

/// Holds the leaves of a patch's parts, and of the parts of those parts, against the patch.
template <Scheme S>
void compare_parts(const Patch<S>& patch, const PatchNode<S>& node, const BoxSpace& space, int levels, Random& random,
                   Compared& seen) {
  using Polynomial = RegularPatch<S::face_kind>;
  TreeTotals totals;
  typename Parts<S>::Slot slot{nullptr};
  const Parts<S>& parts = Parts<S>::of(node, slot, space, totals);
  CHECK(totals.bytes == Parts<S>::bytes_in(slot));
  for (std::size_t i = 0; i < parts.count(); ++i) {
    const typename Parts<S>::Part part = parts.part(i);
    const SubDomain piece = Pieces<Polynomial>::domain(part.piece);
    const Place place = part.patch.place().part(piece);
    if (part.parts && levels > 0) {
      compare_parts(patch, part.patch, space, levels - 1, random, seen);
      continue;
    }
    seen.area += std::abs(place.domain().scale.prod());
    if (!part.patch.is_polynomial()) continue;
    ++seen.polynomials;
    const auto polynomial = static_cast<const PolynomialPatch<S>&>(part.patch).polynomial();
    for (int k = 0; k < 5; ++k) {
      const auto at = random_parameter<typename Polynomial::DomainType>(random);
      const Vec3 limit = evaluate(patch, place.domain()(at)).position;
      seen.worst = std::max(seen.worst, (polynomial.position(piece(at)) - limit).norm());
    }
  }
  delete slot.load();
}

template <Scheme S>
void compare_faces(const ControlMesh& control) {
  const SchemeSurface<S> surface(control);
  const BoxSpace space(hull_of(control.positions));
  Random random(11);
  Compared seen;
  int faces = 0;
  for (const int face : surface.mesh().faces()) {
    const Patch<S> patch = surface.patch(face, 0);
    const auto node = PatchNode<S>::make(patch, {SubDomain(), 0, hull_of(patch.points).rounding()});
    if (node->is_leaf()) continue;
    ++faces;
    compare_parts(patch, *node, space, 2, random, seen);
  }
  REQUIRE(faces > 0);
  CHECK(seen.area == Approx(faces));
  CHECK(seen.polynomials > 3 * faces);
  CHECK(seen.worst <= 2e-14);  // coordinates below 6, and some ten levels of sums
}

/// A shaken sheet with a crease from rim to rim, another that ends, a sharp corner, and none at its own rim.
ControlMesh with_creases(const std::string& scheme, float sharpness) {
  ControlMesh mesh = shaken(sheet(scheme, 5, 5), 0.3);
  for (int i = 0; i < 5; ++i) mesh.sharp_edges.push_back({12 + i, 13 + i, sharpness});
  for (int j = 3; j < 5; ++j) mesh.sharp_edges.push_back({6 * j + 3, 6 * j + 9, 10});
  mesh.sharp_vertices.push_back({7, 10});
  return mesh;
}

}  // namespace

TEST_CASE("Polynomials of a tree are the limit, whether they share points, are strips or have points of their own",
          "[intersect][parts]") {
  for (const int valence : {3, 5, 12}) {
    CAPTURE(valence);
    compare_faces<CatmullClark>(shaken(poles("catmark", valence), 0.1));
    compare_faces<Loop>(shaken(poles("triangle", valence), 0.1));
  }
  for (const float sharpness : {0.5F, 3.0F, 10.0F}) {
    CAPTURE(sharpness);
    compare_faces<CatmullClark>(with_creases("catmark", sharpness));
    compare_faces<Loop>(with_creases("triangle", sharpness));
  }
}

TEST_CASE("Bicubics of a split share their points", "[intersect][parts]") {
  const SchemeSurface<CatmullClark> surface(shaken(poles("catmark", 5), 0.1));
  const BoxSpace space(hull_of(surface.control_mesh().positions));
  const Patch<CatmullClark> patch = surface.patch(0, 0);
  const auto node = PatchNode<CatmullClark>::make(patch, {});
  const Parts<CatmullClark> parts(*node, space);
  std::size_t polynomials = 0;
  for (std::size_t i = 0; i < parts.count(); ++i) polynomials += parts.part(i).patch.is_polynomial() ? 1U : 0U;
  REQUIRE(polynomials >= 6);
  // 384 bytes are a bicubic's own points; of three that share theirs each has 200.
  CHECK(parts.bytes() < 320 * polynomials + 2000);
}

}  // namespace shaolin
