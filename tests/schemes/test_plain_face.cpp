// Faces matched by their valences, against the walk around them.
#include "schemes/catmull_clark.h"
#include "schemes/loop.h"
#include "schemes/subdivision_mesh.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// How many faces are plain, seen from each corner; each has the configuration and the points that the walk finds.
template <Scheme S>
int check_plain_faces(const ControlMesh& control) {
  const SubdivisionMesh<S> mesh(control);
  int count = 0;
  for (const int f : mesh.faces())
    for (int k = 0; k < mesh.face_size(f); ++k) {
      const std::optional<PlainFace> plain = plain_face(mesh, {f, k});
      if (!plain) continue;
      ++count;
      const auto walked = mesh.table().match(mesh.neighbourhood({f, k}, 1));
      REQUIRE(plain->vertices == walked.vertices);
      const Configuration<S>* known = mesh.table().plain(plain->valences);
      if (known) CHECK(known == walked.configuration);
      // The first patch of its kind is walked to, the second is not.
      for (int i = 0; i < 2; ++i) {
        const Patch<S> patch = mesh.patch({f, k});
        REQUIRE(patch.configuration == walked.configuration);
        REQUIRE(patch.points.size() == walked.vertices.size());
        for (std::size_t p = 0; p < patch.points.size(); ++p) CHECK(patch.points[p] == mesh.point(walked.vertices[p]));
      }
    }
  return count;
}

}  // namespace

TEST_CASE("Plain faces have the configuration that the walk around them finds", "[schemes][plain_face]") {
  int quads = 0, triangles = 0;
  for (const Model& model : all_models()) {
    INFO(model.name);
    if (model.scheme == "catmark") quads += check_plain_faces<CatmullClark>(model.mesh);
    if (model.scheme == "loop") triangles += check_plain_faces<Loop>(model.mesh);
  }
  CHECK(quads > 1000);
  CHECK(triangles > 1000);
}

TEST_CASE("Which faces are plain", "[schemes][plain_face]") {
  CHECK(check_plain_faces<CatmullClark>(torus("catmark", 5, 7)) == 4 * 35);
  CHECK(check_plain_faces<Loop>(torus("loop", 5, 7)) == 3 * 70);
  // Here the faces around a face meet again behind the torus.
  CHECK(check_plain_faces<CatmullClark>(torus("catmark", 3, 7)) == 0);
  ControlMesh tagged = torus("catmark", 5, 7);
  tagged.sharp_edges.push_back({tagged.face(0)[0], tagged.face(0)[1], 1});
  // The ends of the edge are corners of six faces.
  CHECK(check_plain_faces<CatmullClark>(tagged) == 4 * (35 - 6));
  tagged.sharp_edges.clear();
  tagged.sharp_vertices.push_back({tagged.face(0)[0], 1});
  CHECK(check_plain_faces<CatmullClark>(tagged) == 4 * (35 - 4));
}

}  // namespace shaolin
