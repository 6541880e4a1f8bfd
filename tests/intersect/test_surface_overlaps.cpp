// Two surfaces overlap where brute force says so, and where one is moved on to the other by their distance.
#include "intersect/scene.h"
#include "tests/catch.h"
#include "tests/intersect/shape_models.h"
#include "tools/validate/dense_sampling.h"

namespace shaolin {

namespace {

Affine moved_by(const Vec3& way) { return Affine(Eigen::Translation3d(way)); }

/// A point that is one on both surfaces, by their evaluation alone; in units of the size.
double error_of(const SurfaceContact& contact, const Scene& a, const Scene& b, double size) {
  const auto at = [](const Scene& scene, const ShapeContact& place) -> Vec3 {
    return scene.instances()[static_cast<std::size_t>(place.instance)].transform *
           scene.surface(place.instance).evaluate(place.at)->position;
  };
  const Vec3 on_a = at(a, contact.own), on_b = at(b, contact.other);
  return std::max({(on_a - on_b).norm(), (on_a - contact.own.sample.position).norm(),
                   (on_b - contact.other.sample.position).norm(),
                   (contact.own.on_shape - contact.other.sample.position).norm()}) /
         size;
}

}  // namespace

TEST_CASE("Surfaces that cross overlap, surfaces apart do not", "[intersect][surface_overlaps]") {
  Random random(51);
  const auto models = shape_models();
  for (const Model& model : models) {
    const Model& other = models[static_cast<std::size_t>(random.index(static_cast<int>(models.size())))];
    const auto one = make_object(model.mesh, model.scheme), two = make_object(other.mesh, other.scheme);
    const Scene a(std::vector<Instance>{{one}});
    const DenseSampling samples(a.surface(), 4), others(Scene(std::vector<Instance>{{two}}).surface(), 4);
    const double size = model.mesh.diagonal();
    int found = 0;
    std::uint64_t most = 0;
    double error = 0;
    for (int i = 0; i < 12; ++i) {
      // A random turn, the size of the other or less, and a point of the one on a point of the other, or beside it.
      Affine map = Affine::Identity();
      const double scale = random.uniform(0.2, 1) * size / other.mesh.diagonal();
      map.linear() = scale * random_axes(random);
      const auto& from =
          others.samples()[static_cast<std::size_t>(random.index(static_cast<int>(others.samples().size())))];
      const auto& to =
          samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))];
      const bool meets = i % 2 == 0;
      map.translation() = to.position - map.linear() * from.position + (meets ? 0 : 0.3) * size * random.point();
      const Scene b(std::vector<Instance>{{two, map}});
      const std::uint64_t before = a.statistics().cells;
      const auto contact = a.overlaps(b);
      most = std::max(most, a.statistics().cells - before);
      found += contact.has_value();
      if (meets) CHECK(contact);
      if (contact) error = std::max(error, error_of(*contact, a, b, size));
      CHECK(b.overlaps(a).has_value() == contact.has_value());
      if (contact) continue;
      // No sample of the one may be nearer to the other than half of what its neighbours are apart.
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < samples.samples().size(); k += 1 + samples.samples().size() / 100)
        least = std::min(least, b.closest_point(samples.samples()[k].position)->distance);
      CHECK(least > 0);
    }
    CAPTURE(model.name, other.name, found, most);
    CHECK(error < 1e-12);
    CHECK(found >= 6);
    CHECK(most < 100000);
  }
}

TEST_CASE("Edges, corners and folds that touch, or nearly, take few cells", "[intersect][surface_overlaps]") {
  // Samples include vertices. There faces of creased cubes are smooth disks whose sides meet in one line; a pillow
  // folds. Cells are then needles, and rows of them at one place: some of these poses took 1e6 to 4e8 cells.
  Random random(52);
  std::vector<Model> models;
  for (const Model& model : shape_models())
    if (model.name == "cube_creases" || model.name == "saddle" || model.name == "sail" || model.name == "pillow")
      models.push_back(model);
  REQUIRE(models.size() == 4);
  for (const Model& model : models)
    for (const Model& other : models) {
      const auto one = make_object(model.mesh, model.scheme), two = make_object(other.mesh, other.scheme);
      const Scene a(std::vector<Instance>{{one}});
      const DenseSampling samples(a.surface(), 2), others(Scene(std::vector<Instance>{{two}}).surface(), 2);
      std::uint64_t most = 0;
      for (int i = 0; i < 60; ++i) {
        const auto any = [&](const DenseSampling& of) {
          return of.samples()[static_cast<std::size_t>(random.index(static_cast<int>(of.samples().size())))].position;
        };
        Affine map(random_axes(random));
        const Vec3 from = any(others), to = any(samples), aside = random.direction();
        const double gap = i % 2 == 0 ? 0 : std::pow(10, random.uniform(-7, -2));
        map.translation() = to - map.linear() * from + gap * aside;
        const std::uint64_t before = a.statistics().cells;
        const auto contact = a.overlaps(Scene(std::vector<Instance>{{two, map}}));
        most = std::max(most, a.statistics().cells - before);
        if (gap == 0) CHECK(contact);
      }
      CAPTURE(model.name, other.name, most);
      CHECK(most < 100000);
    }
}

TEST_CASE("Surfaces that just touch, or just fail to, are told apart with few cells", "[intersect][surface_overlaps]") {
  const auto ball = make_object(cube(), "catmark"), pins = make_object(poles("loop", 7), "loop");
  const Scene lower(std::vector<Instance>{{ball}});
  const double top = lower.closest_point({0, 0, 9})->sample.position.z();
  std::uint64_t most = 0;
  for (const auto& upper : {ball, pins}) {
    const Scene alone(std::vector<Instance>{{upper}});
    const double bottom = alone.closest_point({0, 0, -9})->sample.position.z();
    for (const double gap : {1e-3, 1e-9, 1e-12, -1e-12, -1e-9, -1e-3}) {
      const Scene above(std::vector<Instance>{{upper, moved_by({0, 0, top - bottom + gap})}});
      const std::uint64_t before = lower.statistics().cells;
      const auto contact = lower.overlaps(above);
      const std::uint64_t cells = lower.statistics().cells - before;
      CAPTURE(gap, cells);
      CHECK(contact.has_value() == (gap < 0));
      CHECK(cells < 200000);
      if (contact) CHECK(error_of(*contact, lower, above, 2) < 1e-12);
      most = std::max(most, cells);
    }
  }
  CAPTURE(most);
  CHECK(most < 200000);
}

TEST_CASE("A surface overlaps itself, instances overlap in their order, and nothing overlaps nothing",
          "[intersect][surface_overlaps]") {
  const auto object = make_object(shaken(cube(), 0.2), "catmark");
  const Scene one(std::vector<Instance>{{object}}), none(std::vector<Instance>{});
  CHECK(one.overlaps(one));
  CHECK(!one.overlaps(none));
  CHECK(!none.overlaps(one));
  const Scene three(std::vector<Instance>{
      {object, moved_by({50, 0, 0})}, {object, moved_by({0, 50, 0})}, {object, moved_by({0.4, 0.5, 0.3})}});
  const auto contact = one.overlaps(three);
  REQUIRE(contact);
  CHECK(contact->other.instance == 2);
  CHECK(error_of(*contact, one, three, 2) < 1e-12);
  const auto again = one.overlaps(three);
  CHECK(again->own.sample.position == contact->own.sample.position);
  CHECK(!one.overlaps(Scene(std::vector<Instance>{{object, moved_by({50, 0, 0})}})));
}

}  // namespace shaolin
