// Shapes overlap surfaces where brute force says so, where distances say so, and wherever the same is asked otherwise.
#include "intersect/patch_budget.h"
#include "intersect/scene.h"
#include "schemes/load_plugin.h"
#include "tests/catch.h"
#include "tests/intersect/dense_sampling.h"
#include "tests/intersect/shape_distance.h"
#include "tests/intersect/shape_models.h"
#include "tests/plugins/plugin_files.h"

namespace shaolin {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

void check_against_brute_force(const Model& model, int count, int steps) {
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
  for (const Model& model : shape_models()) check_against_brute_force(model, 60, 6);
}

TEST_CASE("Shapes overlap a surface where brute force says so: all models", "[intersect][overlaps][sweep]") {
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    if ((scene.bounds().lower.array() > scene.bounds().upper.array()).any()) continue;
    check_against_brute_force(model, 200, model.mesh.face_count() > 1500 ? 4 : 8);
  }
}

TEST_CASE("Shapes that just touch, or just fail to, are told apart with few cells", "[intersect][overlaps]") {
  std::uint64_t most = 0;
  for (const Model& model : shape_models()) most = std::max(most, check_touching(model, 8));
  CAPTURE(most);
  CHECK(most < 20000);
}

}  // namespace shaolin
