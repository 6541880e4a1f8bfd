// Boxes of faces that nobody has refined: against the surface, and against one refinement step.
#include "intersect/face_bounds.h"
#include "schemes/catmull_clark.h"
#include "schemes/linear.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

namespace {

struct BoundsFound {
  int faces = 0, irregular = 0, outside = 0;
  double box_area = 0, sample_area = 0;  ///< of irregular faces
};

/// Samples of the limit against the boxes of all faces.
template <Scheme S>
BoundsFound compare_bounds(const ControlMesh& control, const S& scheme = {}) {
  const SchemeSurface<S> surface(control, scheme);
  const SubdivisionMesh<S>& mesh = surface.mesh();
  const std::vector<Box> boxes = face_bounds(mesh);
  BoundsFound found;
  constexpr int steps = 8;
  for (const int f : mesh.faces()) {
    if (!mesh.has_limit(f)) continue;
    const Box& box = boxes[static_cast<std::size_t>(f)];
    Box samples;
    bool is_regular = true;
    for (int sub = 0; sub < surface.sub_count(f); ++sub) {
      is_regular &= surface.patch(f, sub).is_regular();
      for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps - (surface.triangular() ? i : 0); ++j)
          samples.add(
              surface.evaluate({f, sub, static_cast<double>(i) / steps, static_cast<double>(j) / steps})->position);
    }
    ++found.faces;
    found.outside +=
        (samples.lower.array() < box.lower.array()).any() || (samples.upper.array() > box.upper.array()).any();
    if (is_regular) continue;
    ++found.irregular;
    found.box_area += box.half_area();
    found.sample_area += samples.half_area();
  }
  return found;
}

BoundsFound compare_bounds(const std::string& scheme, const ControlMesh& mesh) {
  if (scheme == "loop") return compare_bounds<Loop>(mesh);
  if (scheme == "catmark") return compare_bounds<CatmullClark>(mesh);
  return {};
}

/// Edges with sharpness 0.1 to infinity, or none.
ControlMesh with_random_creases(ControlMesh mesh, Random& random) {
  std::vector<SharpEdge> edges;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto v = mesh.face(f);
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (random.uniform() > 0.3) continue;
      const double kind = random.uniform();
      const float sharpness = kind < 0.3 ? 10.0F : static_cast<float>(3 * random.uniform() + 0.1);
      edges.push_back({v[i], v[(i + 1) % v.size()], sharpness});
    }
  }
  mesh = with_edges(std::move(mesh), edges);
  for (int v = 0; v < static_cast<int>(mesh.positions.size()); ++v)
    if (random.uniform() < 0.1) mesh.sharp_vertices.push_back({v, static_cast<float>(3 * random.uniform())});
  return mesh;
}

}  // namespace

TEST_CASE("Boxes of faces hold the limit", "[intersect][bounds][sweep]") {
  int faces = 0;
  for (const Model& model : all_models()) {
    if (model.mesh.face_count() > 4000) continue;
    INFO(model.name);
    const BoundsFound found = compare_bounds(model.scheme, model.mesh);
    CHECK(found.outside == 0);
    faces += found.faces;
  }
  CHECK(faces > 1000);
}

TEST_CASE("Boxes of faces hold the limit whatever is sharp", "[intersect][bounds][sweep]") {
  Random random(31);
  for (int round = 0; round < 20; ++round) {
    for (const std::string scheme : {"catmark", "loop"}) {
      for (const ControlMesh& mesh : {torus(scheme, 5, 4), poles(scheme, 3 + round % 7), sheet(scheme, 3, 3)}) {
        INFO(round << " " << scheme);
        CHECK(compare_bounds(scheme, with_random_creases(shaken(mesh, 0.2, 100 + round), random)).outside == 0);
      }
    }
    CHECK(compare_bounds("catmark", with_random_creases(shaken(prism(3 + round % 6), 0.2, round), random)).outside ==
          0);
  }
  CHECK(compare_bounds<Bilinear>(shaken(cube(), 0.3)).outside == 0);
  CHECK(compare_bounds<Linear>(shaken(tetrahedron(), 0.3)).outside == 0);
}

TEST_CASE("Boxes of irregular faces are less than three times as large as they need be", "[intersect][bounds]") {
  // Of hulls of control neighbourhoods it is ten times.
  for (const char* name : {"rook", "whale", "spot_catmark", "catmark_car", "spot_loop"})
    for (const Model& model : all_models()) {
      if (model.name != name) continue;
      INFO(name);
      const BoundsFound found = compare_bounds(model.scheme, model.mesh);
      CHECK(found.irregular > 0);
      CHECK(found.box_area < 3 * found.sample_area);
    }
}

TEST_CASE("What lies outside of a face has no more than its share in the face's limit", "[intersect][bounds]") {
  // The share is of faces after one step: of irregular ones, by their patches' children.
  for (int n = 3; n <= 12; ++n) {
    INFO(n);
    const ControlMesh control = poles("catmark", n);
    const SubdivisionMesh<CatmullClark> mesh(control);
    const double share = RefinedBounds<CatmullClark>(mesh).outside_share();
    CHECK(share < 0.42);
    Patch<CatmullClark> child = mesh.patch({0, 0}).child(0);
    const FaceSides& face = child.configuration->neighbourhood().face;
    for (Vec3& point : child.points) point = Vec3::Ones();
    for (int k = 0; k < face.size(); ++k) child.points[static_cast<std::size_t>(face.vertex(k))] = Vec3::Zero();
    const Box limit = split_limit_bound(child, 5);
    CHECK(limit.upper.x() < share);
    CHECK(limit.upper.x() > 0.2);
  }
}

}  // namespace shaolin
