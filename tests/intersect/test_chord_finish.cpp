// The chord finish and its baseline A3 against the exact finish, and each part of the algorithm against its absence.
#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/intersect/aimed_rays.h"
#include "tests/intersect/method_models.h"
#include "tests/intersect/random_rays.h"
#include "tests/intersect/tolerance_band.h"

namespace shaolin {

namespace {

double diagonal(const Scene& scene) { return (scene.bounds().upper - scene.bounds().lower).norm(); }

SceneOptions by_chords(double epsilon, Method method = Method::chord) {
  SceneOptions options;
  options.method = method;
  options.chord.epsilon = epsilon;
  return options;
}

/// A model with its exact scene, and rays.
struct Reference {
  Model model;
  Scene exact;
  double size;

  explicit Reference(const Model& m) : model(m), exact(m.mesh, m.scheme), size(diagonal(exact)) {}
  Scene scene(const SceneOptions& options) const { return Scene(model.mesh, model.scheme, options); }

  Agreements compare(const SceneOptions& options, const std::vector<Ray>& rays) const {
    const Scene chords = scene(options);
    Agreements all;
    for (const Ray& ray : rays) all.add(agreement(exact, ray, chords.intersect(ray), 2 * options.chord.epsilon));
    return all;
  }
};

/// Valence three besides: too few rays at random meet it for the figures of other methods.
std::vector<Model> chord_models() {
  std::vector<Model> models = method_models();
  models.insert(models.begin() + 2, {"poles of three", "loop", shaken(poles("loop", 3), 0.2)});
  return models;
}

/// Lost and misplaced hits over all these models.
Agreements over_models(const ChordOptions& parts, int rays) {
  Agreements all;
  for (const Model& model : chord_models()) {
    const Reference reference(model);
    SceneOptions options = by_chords(2e-3 * reference.size);
    const double epsilon = options.chord.epsilon;
    options.chord = parts;
    options.chord.epsilon = epsilon;
    const Agreements some = reference.compare(options, random_rays(reference.exact.bounds(), rays, 77));
    all.same += some.same;
    all.in_band += some.in_band;
    all.lost += some.lost;
    all.ghosts += some.ghosts;
  }
  return all;
}

/// Of hits: the median distance along the ray from the exact one, relative to the model, and the mean level.
struct Quality {
  double error, level;
};
Quality quality(const Reference& reference, const SceneOptions& options) {
  const Scene chords = reference.scene(options);
  std::vector<double> errors;
  double levels = 0;
  for (const Ray& ray : random_rays(reference.exact.bounds(), 1500, 31)) {
    const auto a = reference.exact.intersect(ray), b = chords.intersect(ray);
    if (!a || !b) continue;
    errors.push_back(std::abs(a->t - b->t) * ray.direction.norm() / reference.size);
    levels += b->level;
  }
  REQUIRE(errors.size() > 100);
  levels /= static_cast<double>(errors.size());
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return {errors[errors.size() / 2], levels};
}

}  // namespace

TEST_CASE("Chord faces lose no hit outside the band of their tolerance", "[intersect][chord]") {
  for (const double epsilon : {3e-2, 3e-3, 3e-4})
    for (const Model& model : chord_models()) {
      const Reference reference(model);
      CAPTURE(model.name, model.scheme, epsilon);
      const Agreements found =
          reference.compare(by_chords(epsilon * reference.size), random_rays(reference.exact.bounds(), 2000, 41));
      CHECK(found.same > 1950);
      CHECK(found.lost == 0);
      CHECK(found.ghosts == 0);
    }
}

TEST_CASE("Nor on any model of data/ and the shapes", "[intersect][chord][sweep]") {
  for (const Model& model : all_models()) {
    const Reference reference(model);
    CAPTURE(model.name, model.scheme);
    const Agreements found =
        reference.compare(by_chords(1e-3 * reference.size), random_rays(reference.exact.bounds(), 500, 43));
    CHECK(found.lost == 0);
    CHECK(found.ghosts == 0);
  }
}

TEST_CASE("Rays aimed at edges and vertices meet the chord faces there", "[intersect][chord]") {
  Random random(5);
  for (const Model& model : chord_models()) {
    if (model.name == "holed sheet") continue;  // on its border chord faces may end before the limit does
    const Reference reference(model);
    CAPTURE(model.name, model.scheme);
    const double epsilon = 1e-2 * reference.size;
    const Scene chords = reference.scene(by_chords(epsilon));
    const LimitSurface& surface = chords.surface();
    for_each_patch(surface, [&](int face, int sub) {
      for (std::size_t side = 0; side < domain_corners(surface).size(); ++side)
        for (const double along : {0.0, 0.5, 0.3}) {
          const LimitSample at = *surface.evaluate(on_side(surface, face, sub, side, along));
          for (int k = 0; k < 3; ++k) {
            // Not along the surface, where the band of the tolerance is.
            Vec3 direction = random.direction();
            if (std::abs(direction.dot(at.normal)) < 0.5) direction = at.normal;
            const Ray ray = ray_at(at.position, direction, 3 * reference.size);
            const auto hit = chords.intersect(ray);
            CAPTURE(face, sub, side, along, k);
            REQUIRE(hit);
            REQUIRE(fault_of(chords, ray, *hit, reference.size) == "");
            REQUIRE(hit->t <= 3 * reference.size + 3 * epsilon);
            REQUIRE(chords.occluded(ray));
          }
        }
    });
  }
}

TEST_CASE("A hit's normal is on the side of its chord face", "[intersect][chord]") {
  // Chord faces of whole patches, met so flat that many interpolated normals look to the other side.
  for (const Method method : {Method::chord, Method::a3})
    for (const Model& model : chord_models()) {
      const Reference reference(model);
      CAPTURE(model.name, model.scheme);
      SceneOptions options = by_chords(reference.size, method);
      options.chord.valid_patches = false;
      const Scene chords = reference.scene(options);
      const LimitSurface& surface = chords.surface();
      const double off = 1e-6 * reference.size;
      for_each_patch(surface, [&](int face, int sub) {
        std::array<Vec3, 3> corners;  // of a triangle, or of half a quad
        for (std::size_t k = 0; k < 3; ++k) corners[k] = surface.evaluate(on_side(surface, face, sub, k, 0))->position;
        const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3;
        const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        for (const Vec3& corner : corners)
          for (const double side : {-0.02, 0.02})
            for (const double way : {-1.0, 1.0}) {
              Ray ray = ray_at(centre, way * (corner - centre).normalized() + side * normal, off);
              ray.tmax = 2 * off;  // where no other face is
              ray.footprint.width = reference.size;
              const auto hit = chords.intersect(ray);
              CAPTURE(face, sub, side, way);
              REQUIRE(hit);
              REQUIRE(hit->sample.normal.dot(ray.direction) * side > 0);
            }
      });
    }
}

TEST_CASE("Without W-cases rays are lost", "[intersect][chord]") {
  ChordOptions parts;
  parts.w_cases = false;
  CHECK(over_models(parts, 4000).lost > 0);
}

TEST_CASE("Without gap polygons rays are lost", "[intersect][chord]") {
  ChordOptions parts;
  parts.gap_polygons = false;
  CHECK(over_models(parts, 4000).lost > 0);
}

TEST_CASE("Without border areas rays are lost", "[intersect][chord]") {
  ChordOptions parts;
  parts.border_areas = false;
  CHECK(over_models(parts, 4000).lost > 0);
}

TEST_CASE("With all parts, none of these rays is", "[intersect][chord]") { CHECK(over_models({}, 4000).lost == 0); }

namespace {

/// A sheet whose middle face bulges like that of the paper's Figure 12: its own corners stand up, the control points
/// around are drawn in under it, across the middle by `pull`, and go down by `depth` a step.
Model bulging(const std::string& scheme, double pull, double depth) {
  ControlMesh mesh = sheet(scheme, 5, 5);
  const auto face = mesh.face(scheme == "loop" ? 24 : 12);
  Vec3 centre = Vec3::Zero();
  for (const int v : face) centre += mesh.positions[static_cast<std::size_t>(v)] / static_cast<double>(face.size());
  std::vector<Vec3> moved;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3 way = mesh.positions[v] - centre;
    const bool is_own = std::find(face.begin(), face.end(), static_cast<int>(v)) != face.end();
    moved.push_back(is_own ? Vec3(way.x(), way.y(), 1) : Vec3(-0.7 * pull * way.normalized()));
    if (!is_own) moved.back().z() = -depth * way.norm();
  }
  mesh.positions = moved;
  return {"bulging", scheme, mesh};
}

}  // namespace

TEST_CASE("Without the test of patches that bulge beyond their chords rays are lost", "[intersect][chord][sweep]") {
  Agreements with, without;
  for (const std::string scheme : {"loop", "catmark"})
    for (const double pull : {0.5, 0.6, 1.0, 1.2, 1.5})
      for (const double depth : {1.0, 2.0}) {
        const Reference reference(bulging(scheme, pull, depth));
        CAPTURE(scheme, pull, depth);
        SceneOptions options = by_chords(2e-3 * reference.size);
        const Scene chords = reference.scene(options);
        options.chord.valid_patches = false;
        const Scene unchecked = reference.scene(options);
        for (const Ray& ray : random_rays(reference.exact.bounds(), 3000, 7)) {
          const double band = 2 * options.chord.epsilon;
          with.add(agreement(reference.exact, ray, chords.intersect(ray), band));
          without.add(agreement(reference.exact, ray, unchecked.intersect(ray), band));
        }
        CHECK(chords.statistics().invalid_patches > 0);
        CHECK(unchecked.statistics().invalid_patches == 0);
      }
  CHECK(without.lost > 0);
  CHECK(with.lost == 0);
  CHECK(with.ghosts == 0);
}

TEST_CASE("Error and level follow epsilon", "[intersect][chord]") {
  for (const Method method : {Method::chord, Method::a3})
    for (const Model& model : chord_models()) {
      CAPTURE(model.name, model.scheme);
      const Reference reference(model);
      const Quality coarse = quality(reference, by_chords(1e-2 * reference.size, method));
      const Quality fine = quality(reference, by_chords(1e-3 * reference.size, method));
      CHECK(coarse.error < 1e-2);
      CHECK(fine.error < 1e-3);
      CHECK(fine.error < 0.3 * coarse.error);
      CHECK(fine.level > coarse.level + 1);  // four times nearer a level
      CHECK(fine.level < coarse.level + 2.5);
    }
}

TEST_CASE("Sizes in pixels have the last word", "[intersect][chord]") {
  const Reference reference({"poles", "loop", shaken(poles("loop", 7), 0.1)});
  const std::vector<Ray> rays = random_rays(reference.exact.bounds(), 300, 3);
  const auto levels = [&](double min_size, double max_size, double width) {
    SceneOptions options = by_chords(1e-6 * reference.size);
    options.chord.min_size = min_size;
    options.chord.max_size = max_size;
    const Scene chords = reference.scene(options);
    std::vector<int> found;
    for (Ray ray : rays) {
      ray.footprint.width = width;
      if (const auto hit = chords.intersect(ray)) found.push_back(hit->level);
    }
    REQUIRE(found.size() > 50);
    return std::pair(*std::min_element(found.begin(), found.end()), *std::max_element(found.begin(), found.end()));
  };
  // Chords of the control faces are shorter than the model: one pixel, or two, of that size holds them.
  CHECK(levels(1, 2, reference.size) == std::pair(0, 0));
  // Epsilon asks for more than pixels of 1/64 do, by far; chords halve from level to level.
  const auto [low, high] = levels(2, 12, reference.size / 64);
  CHECK(low >= 1);
  CHECK(high <= 6);
  // What is larger than 4 pixels is refined, whatever a large epsilon says.
  SceneOptions rough = by_chords(reference.size);
  rough.chord.min_size = 1;
  rough.chord.max_size = 4;
  const Scene chords = reference.scene(rough);
  for (Ray ray : rays) {
    CHECK((!chords.intersect(ray) || chords.intersect(ray)->level == 0));
    ray.footprint.width = reference.size / 1000;
    const auto hit = chords.intersect(ray);
    if (hit && std::abs(hit->sample.normal.dot(ray.direction.normalized())) > 0.5) CHECK(hit->level >= 4);
  }
}

TEST_CASE("An instance is refined as its size in the world asks", "[intersect][chord]") {
  const Model model{"poles", "catmark", shaken(poles("catmark", 5), 0.1)};
  const SceneOptions options = by_chords(0.02);
  const auto object = make_object(model.mesh, model.scheme, options);
  Affine twice = Affine::Identity();
  twice.linear() *= 2;
  const Scene alone({Instance{object}}), doubled({Instance{object, twice}});
  const Scene finer({Instance{make_object(model.mesh, model.scheme, by_chords(0.01))}});
  for (Ray ray : random_rays(alone.bounds(), 500, 8)) {
    const auto expected = finer.intersect(ray);  // half the tolerance in half the size
    ray.origin *= 2;
    ray.direction *= 2;
    const auto hit = doubled.intersect(ray);
    REQUIRE(hit.has_value() == expected.has_value());
    if (!hit) continue;
    CHECK(hit->level == expected->level);
    CHECK(std::abs(hit->t - expected->t) < 1e-12);
  }
}

TEST_CASE("Border hulls suit instances of any size", "[intersect][chord]") {
  // Shrunk in its own coordinates and as large as ever in the world's: hulls resolved in the object's lengths would
  // fill what lies between its parts.
  const Model model{"poles", "loop", shaken(poles("loop", 7), 0.1)};
  const Reference reference(model);
  for (const double scale : {1e-6, 1e3, 1e6}) {
    CAPTURE(scale);
    ControlMesh small = model.mesh;
    for (Vec3& p : small.positions) p /= scale;
    Affine back = Affine::Identity();
    back.linear() *= scale;
    const double epsilon = 1e-2 * reference.size;
    const Scene chords({Instance{make_object(small, model.scheme, by_chords(epsilon)), back}});
    Agreements all;
    for (const Ray& ray : random_rays(reference.exact.bounds(), 1500, 19))
      all.add(agreement(reference.exact, ray, chords.intersect(ray), 2 * epsilon));
    CHECK(all.same > 1450);
    CHECK(all.lost == 0);
    CHECK(all.ghosts == 0);
  }
}

TEST_CASE("An epsilon below rounding ends where pixels do", "[intersect][chord]") {
  for (const Method method : {Method::chord, Method::a3})
    for (const Model& model : chord_models()) {
      CAPTURE(model.name, model.scheme);
      const Reference reference(model);
      const Scene chords = reference.scene(by_chords(1e-300, method));
      int hits = 0;
      for (Ray ray : random_rays(reference.exact.bounds(), 30, 23)) {
        ray.footprint.width = reference.size / 200;
        hits += chords.intersect(ray).has_value();
      }
      CHECK(hits > 3);
    }
}

TEST_CASE("With no least size, what is flat and seen edge-on is refined to epsilon", "[intersect][chord]") {
  ControlMesh mesh = sheet("catmark", 4, 4);
  for (Vec3& p : mesh.positions) p *= 0.25;
  for (const Method method : {Method::chord, Method::a3}) {
    SceneOptions options = by_chords(0.01, method);
    options.chord.min_size = 0;
    const Scene chords(mesh, "catmark", options);
    Ray ray{Vec3(-2, 0.5, 0), Vec3(1, 0, 0)};  // in the plane
    ray.footprint.growth = 0.04;
    chords.intersect(ray);
    CHECK(chords.statistics().patches_split < 1000);
    CHECK(chords.statistics().depth_bounds == 0);
  }
}

TEST_CASE("The depth bound is counted", "[intersect][chord]") {
  const Reference reference({"poles", "loop", shaken(poles("loop", 5), 0.1)});
  const Scene chords = reference.scene(by_chords(1e-300));
  for (const Ray& ray : random_rays(reference.exact.bounds(), 5, 3)) chords.intersect(ray);
  CHECK(chords.statistics().depth_bounds > 0);
}

TEST_CASE("Of faces that coincide the answer is the exact finish's", "[intersect][chord]") {
  ControlMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::array<int, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<int, 4>{4, 5, 6, 7});
  const Scene exact(mesh, "bilinear");
  for (const Method method : {Method::chord, Method::a3}) {
    const Scene chords(mesh, "bilinear", by_chords(0.01, method));
    for (const double x : {0.3, 0.6}) {
      const Ray ray{Vec3(x, 0.45, 1), Vec3(0, 0, -1)};
      const auto a = exact.intersect(ray), b = chords.intersect(ray);
      REQUIRE((a && b));
      CHECK(a->at.face == b->at.face);
    }
  }
}

TEST_CASE("Chords answer the same in whatever order rays come", "[intersect][chord]") {
  for (const Method method : {Method::chord, Method::a3})
    for (const Model& model : chord_models()) {
      CAPTURE(model.name, model.scheme);
      const Reference reference(model);
      const SceneOptions options = by_chords(2e-3 * reference.size, method);
      const Scene forward = reference.scene(options), backward = reference.scene(options);
      const std::vector<Ray> rays = random_rays(reference.exact.bounds(), 800, 21);
      std::vector<std::optional<Hit>> first;
      for (const Ray& ray : rays) first.push_back(forward.intersect(ray));
      for (std::size_t i = rays.size(); i-- > 0;) {
        const auto again = backward.intersect(rays[i]);
        REQUIRE(same(first[i], again));
        REQUIRE(forward.occluded(rays[i]) == first[i].has_value());
      }
    }
}

TEST_CASE("ShaoLin asks fewer hulls than A3", "[intersect][chord]") {
  for (const Model& model : chord_models()) {
    CAPTURE(model.name, model.scheme);
    const Reference reference(model);
    const auto hull_tests = [&](Method method) {
      const Scene chords = reference.scene(by_chords(1e-3 * reference.size, method));
      for (const Ray& ray : random_rays(reference.exact.bounds(), 500, 13)) chords.intersect(ray);
      return chords.statistics().hull_tests;
    };
    CHECK(2 * hull_tests(Method::chord) < hull_tests(Method::a3));
  }
}

TEST_CASE("Chord options out of range are refused", "[intersect][chord]") {
  const ControlMesh mesh = prism(5);
  const auto message = [&](const SceneOptions& options) -> std::string {
    try {
      make_object(mesh, "catmark", options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  CHECK(message(by_chords(0)) == "epsilon 0 is out of range; expected a positive length");
  CHECK(message(by_chords(-1e-9)) == "epsilon -1e-09 is out of range; expected a positive length");
  CHECK(message(by_chords(std::nan(""))).find("expected a positive length") != std::string::npos);
  SceneOptions sizes = by_chords(1);
  sizes.chord.min_size = 3;
  sizes.chord.max_size = 2;
  CHECK(message(sizes) == "sizes 3 and 2 are out of range; expected 0 <= min_size <= max_size");
  sizes.method = Method::exact;  // which reads none of it
  CHECK(message(sizes) == "none");
}

}  // namespace shaolin
