// Boxes of regular faces against the Bezier points of their patches.
#include "intersect/face_bounds.h"
#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// Holds every regular face's box against its patch; the number of regular faces.
template <Scheme S>
int check_boxes(const ControlMesh& control) {
  const SubdivisionMesh<S> mesh(control);
  const std::vector<Box> all = face_bounds(mesh);
  int count = 0;
  for (const int f : mesh.faces()) {
    const std::optional<Box> box = regular_bound(mesh, f);
    if (!box) continue;
    ++count;
    const Patch<S> patch = mesh.patch({f, 0});
    REQUIRE(patch.is_regular());
    Box points, hull;
    for (const Vec3& point : patch.points) points.add(point);
    for (const Vec3& point : patch.regular().b) hull.add(point);
    const Box expected = hull.grown(points.rounding());
    const double slack = 0.1 * points.rounding();
    CHECK((box->lower - expected.lower).cwiseAbs().maxCoeff() <= slack);
    CHECK((box->upper - expected.upper).cwiseAbs().maxCoeff() <= slack);
    CHECK(all[static_cast<std::size_t>(f)].lower == box->lower);
  }
  return count;
}

}  // namespace

TEST_CASE("Boxes of regular faces are the hulls of their Bezier points, and no face is regular that is not",
          "[intersect][bounds]") {
  int quads = 0, triangles = 0;
  for (const Model& model : all_models()) {
    INFO(model.name);
    if (model.scheme == "catmark") quads += check_boxes<CatmullClark>(model.mesh);
    if (model.scheme == "loop") triangles += check_boxes<Loop>(model.mesh);
  }
  CHECK(check_boxes<CatmullClark>(torus("catmark", 5, 7)) == 35);
  CHECK(check_boxes<Loop>(torus("loop", 5, 7)) == 70);
  CHECK(quads > 100);
  CHECK(triangles > 100);
}

}  // namespace shaolin
