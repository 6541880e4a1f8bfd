// Points inside and outside of closed surfaces.
#include "intersect/scene.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/models.h"
#include "tests/random.h"

namespace shaolin {

namespace {

Box hull_of_points(const ControlMesh& mesh) {
  Box box;
  for (const Vec3& point : mesh.positions) box.add(point);
  return box;
}

bool is_in(const Box& box, const Vec3& p) {
  return (p.array() > box.lower.array()).all() && (p.array() < box.upper.array()).all();
}

}  // namespace

TEST_CASE("A flat cube contains what its box does, whichever way its faces are wound", "[intersect][contains]") {
  ControlMesh mirrored = cube();
  for (Vec3& point : mirrored.positions) point.x() = -point.x();
  for (const ControlMesh& mesh : {cube(), mirrored}) {
    const Scene scene(mesh, "bilinear");
    const Box box = hull_of_points(mesh);
    Random random(3);
    std::vector<Vec3> points{box.centre()};
    for (int i = 0; i < 2000; ++i) points.push_back(box.centre() + random.point().cwiseProduct(box.upper - box.lower));
    // On the axes of symmetry, where rays along them would meet edges and corners.
    for (const double s : {0.1, 0.25, 0.5}) points.push_back(box.centre() + s * (box.upper - box.centre()));
    const std::vector<char> answers = scene.contains(std::span(points));
    int inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK((answers[i] != 0) == is_in(box, points[i]));
      inside += answers[i];
    }
    CHECK(inside > 100);
  }
}

TEST_CASE("Signed distances are negative inside", "[intersect][contains]") {
  const Scene scene(cube(), "bilinear");
  Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) points.push_back(2 * random.point());
  const std::vector<double> answers = scene.signed_distance(std::span(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 beyond = points[i].cwiseAbs() - Vec3::Ones();  // of the cube [-1, 1]^3
    const double outside = beyond.cwiseMax(0).norm(), expected = outside > 0 ? outside : beyond.maxCoeff();
    CHECK(std::abs(answers[i] - expected) < 1e-14);
    CHECK(scene.signed_distance(points[i]) == answers[i]);
  }
  CHECK(Scene(std::vector<Instance>{}).signed_distance(Vec3::Zero()) == std::numeric_limits<double>::infinity());
}

TEST_CASE("Points beside a closed surface are on the side that the normal says", "[intersect][contains][sweep]") {
  int models = 0;
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    const LimitSurface& surface = scene.surface();
    bool is_open = false;
    try {
      scene.contains(scene.bounds().centre());
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find("instance 0: the surface is open") == 0);
      is_open = true;
    }
    // Of surfaces that cross themselves, inside and outside are no matter of the nearest sheet.
    if (is_open || model.name.find("val2") != std::string::npos) continue;
    ++models;
    INFO(model.name);
    Random random(4);
    const double step = 1e-7 * model.mesh.diagonal();
    int same = 0, asked = 0;
    for (int i = 0; i < 200; ++i) {
      const SurfaceParameter at{random.index(surface.face_count()), 0, random.uniform(0.1, 0.4),
                                random.uniform(0.1, 0.4)};
      const std::optional<LimitSample> sample = surface.evaluate(at);
      if (!sample || sample->normal.isZero(0)) continue;
      ++asked;
      same += scene.contains(sample->position + step * sample->normal) ==
              scene.contains(sample->position - step * sample->normal);
    }
    CHECK(asked > 0);
    CHECK(same == 0);
  }
  CHECK(models >= 5);
}

TEST_CASE("Scenes contain what any instance does", "[intersect][contains]") {
  const auto object = make_object(cube(), "bilinear");
  const Box box = hull_of_points(cube());
  const Affine moved = Affine(Eigen::Translation3d(10, 0, 0)) * Affine(Eigen::Scaling(2.0, -1.0, 1.0));
  const Scene scene({{object, Affine::Identity()}, {object, moved}});
  CHECK(scene.contains(box.centre()));
  CHECK(scene.contains(moved * box.centre()));
  CHECK(!scene.contains(Vec3(5, 0, 0)));
  CHECK(!Scene(std::vector<Instance>{}).contains(Vec3::Zero()));
}

TEST_CASE("Open surfaces and points that are none are refused", "[intersect][contains]") {
  CHECK_THROWS_AS(Scene(sheet("catmark", 3, 3), "catmark").contains(Vec3::Zero()), InputError);
  const Scene scene(cube(), "catmark");
  CHECK_THROWS_AS(scene.contains(Vec3(0, std::nan(""), 0)), InputError);
  ControlMesh holed = cube();
  holed.holes = {2};
  CHECK_THROWS_AS(Scene(holed, "catmark").contains(Vec3::Zero()), InputError);
}

}  // namespace shaolin
