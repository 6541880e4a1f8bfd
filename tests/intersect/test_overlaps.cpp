// Shapes overlap surfaces where brute force says so, where distances say so, and wherever the same is asked otherwise.
#include "intersect/patch_budget.h"
#include "intersect/scene.h"
#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/refusal.h"
#include "tests/intersect/shape_distance.h"
#include "tests/intersect/shape_models.h"
#include "tests/plugins/plugin_files.h"
#include "tools/validate/dense_sampling.h"

namespace shaolin {

namespace {

/// Of any kind, about a point.
Shape random_shape(const Vec3& at, double size, Random& random) {
  switch (random.index(4)) {
    case 0:
      return Sphere{at, size * random.uniform(0.1, 1)};
    case 1: {
      const Vec3 half = size * random.point().cwiseAbs();
      return OrientedBox{at, half, random_axes(random)};
    }
    case 2: {
      const Vec3 to = at + 2 * size * random.point();
      return Capsule{at, to, size * random.uniform(0.01, 0.5)};
    }
    default: {
      const Vec3 b = at + 2 * size * random.point();
      return Triangle{at, b, at + 2 * size * random.point()};
    }
  }
}

/// Shapes around a point that hold it, and that a ball about `middle` through a point `touching` holds: so nothing that
/// is beyond the ball is nearer to them than `touching` is. They reach `gap` less far, or farther if that is negative.
std::vector<Shape> shapes_in_ball(const Vec3& middle, const Vec3& touching, double gap, Random& random) {
  const double radius = (touching - middle).norm();
  const Vec3 n = (middle - touching) / radius, tip = touching + gap * n, across = n.unitOrthogonal();
  std::vector<Shape> shapes;
  shapes.push_back(Sphere{middle, radius - gap});
  const double thin = 0.2 * radius;
  const Vec3 inside = middle + 0.5 * (radius - thin) * random.direction();
  shapes.push_back(Capsule{tip + thin * n, inside, thin});
  // A corner ahead: the others are behind it by up to half the radius, and less than that to a side.
  shapes.push_back(Triangle{tip, tip + 0.4 * radius * (n + 0.7 * across), tip + 0.4 * radius * (n - 0.7 * across)});
  shapes.push_back(Triangle{tip, tip + 0.5 * radius * n, tip + radius * n});
  Eigen::Matrix3d axes;  // the diagonal (1, 1, 1) along n
  const Vec3 third = n.cross(across);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 3;
    axes.col(i) = n / std::sqrt(3.0) + std::sqrt(2.0 / 3) * (std::cos(angle) * across + std::sin(angle) * third);
  }
  const double half = 0.25 * radius;
  shapes.push_back(OrientedBox{tip + half * std::sqrt(3.0) * n, Vec3::Constant(half), axes});
  return shapes;
}

bool same(const std::optional<ShapeContact>& a, const std::optional<ShapeContact>& b) {
  if (!a || !b) return !a && !b;
  return a->at.face == b->at.face && a->at.sub == b->at.sub && a->at.u == b->at.u && a->at.v == b->at.v &&
         a->level == b->level && a->instance == b->instance && a->sample.position == b->sample.position &&
         a->sample.normal == b->sample.normal && a->on_shape == b->on_shape;
}

void check_overlaps_against_brute_force(const Model& model, int count, int steps) {
  const Scene scene(model.mesh, model.scheme);
  const LimitSurface& surface = scene.surface();
  const DenseSampling samples(surface, steps);
  const double diagonal = model.mesh.diagonal();
  Random random(21);
  int missed = 0, found = 0;
  double outside = 0, inconsistent = 0;
  for (int i = 0; i < count; ++i) {
    const auto& sample =
        samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))];
    const double size = diagonal * std::exp2(random.uniform(-7, -1));
    const Vec3 at = sample.position + 1.5 * size * random.point();
    const Shape shape = random_shape(at, size, random);
    const auto contact = scene.overlaps(shape);
    if (contact) {
      ++found;
      outside = std::max(outside, distance_from(shape, contact->sample.position) / diagonal);
      outside = std::max(outside, distance_from(shape, contact->on_shape) / diagonal);
      outside = std::max(outside, (contact->on_shape - contact->sample.position).norm() / diagonal);
      inconsistent = std::max(inconsistent,
                              (surface.evaluate(contact->at)->position - contact->sample.position).norm() / diagonal);
    } else {
      for (const auto& one : samples.samples()) missed += distance_from(shape, one.position) == 0;
    }
  }
  CAPTURE(model.name, model.scheme, found);
  CHECK(missed == 0);
  CHECK(outside < 2e-13);
  CHECK(inconsistent < 1e-13);
  CHECK(found > count / 10);
  CHECK(found < count);
  CHECK(scene.statistics().cells < 2000 * static_cast<std::uint64_t>(count));
}

/// Of a shape that just touches, or just fails to: the most cells that a search has looked at.
std::uint64_t check_touching(const Model& model, int count) {
  const Scene scene(model.mesh, model.scheme);
  const double diagonal = model.mesh.diagonal();
  Random random(22);
  std::uint64_t most = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 p =
        scene.bounds().centre() + 0.7 * (scene.bounds().upper - scene.bounds().lower).cwiseProduct(random.point());
    const auto closest = scene.closest_point(p);
    REQUIRE(closest);
    if (closest->distance < 1e-2 * diagonal) continue;
    for (const double gap : {1e-3, 1e-9, 1e-12, -1e-12, -1e-9, -1e-3}) {
      for (const Shape& shape : shapes_in_ball(p, closest->sample.position, gap * diagonal, random)) {
        const std::uint64_t before = scene.statistics().cells;
        const auto contact = scene.overlaps(shape);
        const std::uint64_t cells = scene.statistics().cells - before;
        CAPTURE(model.name, i, shape.index(), gap, cells);
        CHECK(contact.has_value() == (gap < 0));
        CHECK(cells < 20000);
        most = std::max(most, cells);
      }
    }
  }
  return most;
}

}  // namespace

TEST_CASE("Shapes overlap a surface where brute force says so", "[intersect][overlaps]") {
  for (const Model& model : shape_models()) check_overlaps_against_brute_force(model, 60, 6);
}

TEST_CASE("Shapes overlap a surface where brute force says so: all models", "[intersect][overlaps][sweep]") {
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    if ((scene.bounds().lower.array() > scene.bounds().upper.array()).any()) continue;
    check_overlaps_against_brute_force(model, 200, model.mesh.face_count() > 1500 ? 4 : 8);
  }
}

TEST_CASE("Shapes that just touch, or just fail to, are told apart with few cells", "[intersect][overlaps]") {
  std::uint64_t most = 0;
  for (const Model& model : shape_models()) most = std::max(most, check_touching(model, 8));
  CAPTURE(most);
  CHECK(most < 20000);
}

TEST_CASE("Boxes whose sides and edges touch a surface are told apart", "[intersect][overlaps]") {
  // A face of a bilinear cube lies in the box's side; Catmull-Clark's bulges towards it and is highest in its middle.
  for (const std::string scheme : {"bilinear", "catmark"}) {
    const Scene scene(cube(), scheme);
    const double top = scene.closest_point({0, 0, 9})->sample.position.z();
    Eigen::Matrix3d turned = Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
    for (const double gap : {1e-3, 1e-9, 1e-12, 0.0, -1e-12, -1e-9, -1e-3}) {
      const double edge = std::sqrt(0.5);  // half the box's extent along z where it stands on an edge
      const std::vector<Shape> shapes{OrientedBox{{0.1, -0.2, top + gap + 0.5}, {0.3, 0.4, 0.5}},
                                      OrientedBox{{0, 0, top + gap + 5}, {5, 5, 5}},
                                      OrientedBox{{0, 0.01, top + gap}, {0.5, 0.5, 0}},
                                      OrientedBox{{0, 0, top + gap + edge}, {2, 0.5, 0.5}, turned},
                                      Triangle{{-1, -1, top + gap}, {1, -1, top + gap}, {0, 2, top + gap}},
                                      Triangle{{-1, 0, top + gap}, {1, 0, top + gap}, {0, 0, top + gap + 1}},
                                      Triangle{{-1, 0, top + gap}, {1, 0, top + gap}, {1, 0, top + gap}},
                                      Triangle{{0, 0, top + gap}, {0, 0, top + gap}, {0, 0, top + gap}},
                                      Capsule{{-1, 0, top + gap + 0.25}, {1, 0, top + gap + 0.25}, 0.25},
                                      Capsule{{0, 0, top + gap + 0.25}, {0, 0, top + gap + 0.25}, 0.25}};
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        // What has no inside is through the surface when it is below.
        const bool is_thin = i == 2 || i == 4 || i == 6 || i == 7;
        if (is_thin && gap < 0 && (scheme == "bilinear" || i == 7)) continue;
        const std::uint64_t before = scene.statistics().cells;
        const auto contact = scene.overlaps(shapes[i]);
        CAPTURE(scheme, gap, i);
        CHECK(contact.has_value() == (gap <= 0));
        CHECK(scene.statistics().cells - before < 10000);
      }
    }
  }
}

TEST_CASE("Shapes that touch a surface along a line are told apart with few cells", "[intersect][overlaps]") {
  // A ridge, and a groove in which a capsule of nearly its radius lies; the lines run along y.
  for (const double bend : {-0.2, 0.2}) {
    ControlMesh mesh = sheet("catmark", 6, 6);
    for (Vec3& p : mesh.positions) p = Vec3(p.x() - 3, p.y() - 3, bend * (p.x() - 3) * (p.x() - 3));
    const Scene scene(mesh, "catmark");
    const double height = scene.closest_point({0, 0, bend < 0 ? 9.0 : -9.0})->sample.position.z();
    for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-12, -1e-9, -1e-3}) {
      const double z = height + gap;
      std::vector<Shape> shapes{Capsule{{0, -2, z + 0.3}, {0, 2, z + 0.3}, 0.3},
                                Capsule{{0, -2, z + 2}, {0, 2, z + 2}, 2},
                                Triangle{{0, -2, z}, {0, 2, z}, {0, 0, z + 1}}};
      if (bend < 0) shapes.push_back(OrientedBox{{0, 0, z + 1}, {1, 2, 1}});
      for (const Shape& shape : shapes) {
        const std::uint64_t before = scene.statistics().cells;
        const bool overlaps = scene.overlaps(shape).has_value();
        CAPTURE(bend, gap, shape.index());
        CHECK(overlaps == (gap <= 0));
        CHECK(scene.statistics().cells - before < 2000);
      }
    }
  }
}

TEST_CASE("Shapes touch surfaces that are collapsed to a curve", "[intersect][overlaps]") {
  ControlMesh thin = sheet("catmark", 3, 3);
  for (Vec3& p : thin.positions) p = Vec3(p.x(), 0.2 * p.x() * p.x(), 0);
  const Scene scene(thin, "catmark");
  Random random(28);
  for (int i = 0; i < 12; ++i) {
    const Vec3 p = Vec3(1.5, 0.8, 0) + 2 * random.point();
    const auto closest = scene.closest_point(p);
    for (const double gap : {1e-3, 1e-6, 1e-9, -1e-9}) {
      for (const Shape& shape : shapes_in_ball(p, closest->sample.position, gap, random)) {
        const std::uint64_t before = scene.statistics().cells;
        const bool overlaps = scene.overlaps(shape).has_value();
        CAPTURE(i, gap, shape.index());
        CHECK(overlaps == (gap < 0));
        CHECK(scene.statistics().cells - before < 5000);
      }
    }
  }
}

TEST_CASE("Thin shapes cross surfaces without holding a sample", "[intersect][overlaps]") {
  Random random(23);
  for (const Model& model : shape_models()) {
    const Scene scene(model.mesh, model.scheme);
    const LimitSurface& surface = scene.surface();
    const DenseSampling samples(surface, 5);
    const double diagonal = model.mesh.diagonal();
    int missed = 0, count = 0;
    std::uint64_t most = 0;
    for (int i = 0; i < 40; ++i) {
      const Vec3 on =
          samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))]
              .position;
      const Vec3 way = diagonal * random.uniform(0.01, 0.5) * random.direction();
      const Vec3 b = on + random.uniform(0.1, 1) * way, across = way.cross(random.direction());
      for (const Shape& shape : {Shape(Triangle{on - way, b, on}), Shape(Triangle{on - way, b + across, b - across}),
                                 Shape(Capsule{on - way, b, 1e-12 * diagonal}),
                                 Shape(OrientedBox{on, {0, 0, 0.1 * diagonal}, random_axes(random)})}) {
        const std::uint64_t before = scene.statistics().cells;
        missed += !scene.overlaps(shape);
        most = std::max(most, scene.statistics().cells - before);
        ++count;
      }
    }
    CAPTURE(model.name, count, most);
    CHECK(missed == 0);
    CHECK(most < 10000);
  }
}

TEST_CASE("An instance's overlaps are those of the mapped mesh", "[intersect][overlaps][instances][sweep]") {
  Random random(24);
  for (const Model& model : {Model{"cube", "catmark", shaken(cube(), 0.2)}, Model{"poles", "loop", poles("loop", 7)},
                             Model{"sheet", "catmark", shaken(sheet("catmark", 3, 3), 0.3)}}) {
    const auto object = make_object(model.mesh, model.scheme);
    for (int k = 0; k < 6; ++k) {
      const Affine map = random_affine(random), far = Eigen::Translation3d(100, 0, 0) * map;
      const Scene instances(std::vector<Instance>{{object, far}, {object, map}});
      const Scene mapped(image_of(model.mesh, map), model.scheme);
      const double diagonal = (mapped.bounds().upper - mapped.bounds().lower).norm();
      int differ = 0;
      double outside = 0;
      for (int i = 0; i < 60; ++i) {
        const Vec3 p = mapped.bounds().centre() + 0.3 * diagonal * random.point();
        const auto closest = mapped.closest_point(p);
        std::vector<Shape> shapes{random_shape(p, 0.3 * diagonal, random)};
        for (const double gap : {1e-9, -1e-9})
          for (const Shape& shape : shapes_in_ball(p, closest->sample.position, gap * diagonal, random))
            shapes.push_back(shape);
        for (const Shape& shape : shapes) {
          const auto contact = instances.overlaps(shape), expected = mapped.overlaps(shape);
          differ += contact.has_value() != expected.has_value() || (contact && contact->instance != 1);
          if (contact) outside = std::max(outside, distance_from(shape, contact->sample.position) / diagonal);
        }
      }
      CAPTURE(model.name, k);
      CHECK(differ == 0);
      CHECK(outside < 1e-12);
    }
  }
}

TEST_CASE("Overlaps far from the origin and at any scale", "[intersect][overlaps]") {
  Random random(25);
  for (const double scale : {1e-150, 1e-6, 1.0, 1e6, 1e150}) {
    for (const double offset : {0.0, 1e5}) {
      Affine map = Affine::Identity();
      map.linear() *= scale;
      map.translation() = Vec3(offset, -offset, offset) * scale;
      const Scene scene(image_of(shaken(cube(), 0.2), map), "catmark");
      int wrong = 0;
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = map * Vec3(2 * random.point());
        const auto closest = scene.closest_point(p);
        if (closest->distance < 1e-3 * scale) continue;
        for (const double gap : {1e-7, -1e-7})
          for (const Shape& shape : shapes_in_ball(p, closest->sample.position, gap * scale, random))
            wrong += scene.overlaps(shape).has_value() != (gap < 0);
      }
      CAPTURE(scale, offset);
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("An overlap does not depend on what was asked before, on threads or on memory", "[intersect][overlaps]") {
  Random random(26);
  const ControlMesh mesh = shaken(poles("catmark", 9), 0.2);
  std::vector<Shape> shapes;
  for (int i = 0; i < 200; ++i) {
    const Vec3 at = 2 * random.point();
    shapes.push_back(random_shape(at, 0.5, random));
  }
  SceneOptions little;
  little.budget = std::make_shared<PatchBudget>(1);
  const Scene fresh(mesh, "catmark"), backwards(mesh, "catmark"), poor(mesh, "catmark", little);
  const auto all = fresh.overlaps(shapes), again = fresh.overlaps(shapes), tight = poor.overlaps(shapes);
  int differ = 0;
  for (std::size_t i = shapes.size(); i-- > 0;) {
    const auto single = backwards.overlaps(shapes[i]);
    differ += !same(single, all[i]) || !same(single, again[i]) || !same(single, tight[i]);
  }
  CHECK(differ == 0);
  CHECK(little.budget->held() <= 1);
  CHECK(fresh.statistics().shapes + fresh.statistics().points == 2 * shapes.size());
}

TEST_CASE("Surfaces without polynomials overlap", "[intersect][overlaps][plugin][sweep]") {
  Random random(27);
  for (const bool quads : {false, true}) {
    const auto masks = load_plugin(test::example_plugin(quads ? "kobbelt" : "butterfly")).masks;
    const ControlMesh mesh = quads ? shaken(cube(), 0.1) : shaken(tetrahedron(), 0.1);
    const Scene scene(mesh, masks);
    int wrong = 0;
    for (int i = 0; i < 4; ++i) {
      const Vec3 p = 2 * random.point();
      const auto closest = scene.closest_point(p);
      if (closest->distance < 1e-2) continue;
      for (const double gap : {1e-6, -1e-6})
        for (const Shape& shape : shapes_in_ball(p, closest->sample.position, gap, random))
          wrong += scene.overlaps(shape).has_value() != (gap < 0);
    }
    CAPTURE(quads);
    CHECK(wrong == 0);
  }
}

TEST_CASE("Shapes that are none are refused, and nothing overlaps an empty scene", "[intersect][overlaps]") {
  const Scene scene(cube(), "catmark");
  const double nan = std::nan("");
  const Eigen::Matrix3d skew = Eigen::Matrix3d::Identity() + 0.1 * Eigen::Matrix3d::Ones();
  const std::vector<std::pair<Shape, std::string>> bad{
      {Sphere{{nan, 0, 0}, 1}, "is not finite"},
      {Sphere{{0, 0, 0}, 0}, "expected a positive length"},
      {Sphere{{0, 0, 0}, nan}, "expected a positive length"},
      {Sphere{{0, 0, 0}, infinity}, "expected a positive length"},
      {Capsule{{0, infinity, 0}, {0, 0, 0}, 1}, "is not finite"},
      {Capsule{{0, 1, 0}, {0, 0, 0}, -1}, "expected a positive length"},
      {Triangle{{0, 1, 0}, {0, 0, nan}, {0, 0, 0}}, "is not finite"},
      {OrientedBox{{0, 0, 0}, {1, -1, 1}}, "expected a finite length"},
      {OrientedBox{{0, 0, 0}, {1, nan, 1}}, "expected a finite length"},
      {OrientedBox{{0, 0, 0}, {1, 1, 1}, skew}, "at right angles"},
      {OrientedBox{{0, 0, 0}, {1, 1, 1}, nan * skew}, "at right angles"}};
  for (const auto& [shape, message] : bad) {
    const Shape one = shape;
    CAPTURE(message);
    CHECK(refusal_of([&] { scene.overlaps(one); }).find(message) != std::string::npos);
    const std::vector<Shape> all{Sphere{{0, 0, 0}, 1}, one};
    CHECK(refusal_of([&] { scene.overlaps(all); }).find("shape 1: ") == 0);
  }
  SceneOptions uniform;
  uniform.method = Method::uniform;
  CHECK(refusal_of([&] {
          Scene(cube(), "catmark", uniform).overlaps(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 9, 0}});
        }).find("Method::exact") != std::string::npos);

  ControlMesh hole = sheet("catmark", 1, 1);
  hole.holes = {0};
  const Scene none(std::vector<Instance>{}), holes(hole, "catmark");
  for (const Shape& shape :
       {Shape(Sphere{{0, 0, 0}, 9}), Shape(OrientedBox{{0, 0, 0}, {9, 9, 9}}), Shape(Capsule{{0, 0, 0}, {1, 0, 0}, 9}),
        Shape(Triangle{{-9, 0, 0}, {9, 9, 0}, {9, -9, 0}})}) {
    CHECK(!none.overlaps(shape));
    CHECK(!holes.overlaps(shape));
  }
}

}  // namespace shaolin
