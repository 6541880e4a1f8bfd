// Instances answer as the transformed control mesh does: limit surfaces are affine invariant.
#include <functional>
#include <thread>

#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/intersect/random_affine.h"
#include "tests/intersect/random_rays.h"
#include "tests/intersect/refusal.h"
#include "tests/models.h"

namespace shaolin {

namespace {

std::vector<Model> instanced_models() {
  std::vector<Model> all{{"torus", "catmark", shaken(torus("catmark", 4, 6), 0.1)},
                         {"poles", "loop", shaken(poles("loop", 9), 0.2)},
                         {"prism", "catmark", shaken(prism(5), 0.1)},
                         {"fan", "loop", shaken(fan("loop", 4), 0.2)},
                         {"linear poles", "linear", shaken(poles("loop", 5), 0.2)}};
  all[1].mesh.sharp_edges = {{0, 2, 10}, {0, 6, 1.5}};
  return all;
}

/// A rotation, a scale of the axes by factors from 1/4 to 4 (some of them negative), a shear, a shift.
Affine random_map(Random& random, bool mirrored) {
  Affine map = Affine::Identity();
  map.linear() = Eigen::AngleAxisd(random.uniform(0, 6), random.direction()).toRotationMatrix();
  Vec3 scale;
  for (double& factor : scale) factor = std::exp2(random.uniform(-2, 2)) * (random.index(2) ? 1 : -1);
  if ((scale.prod() < 0) != mirrored) scale.x() = -scale.x();
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = random.uniform(-1, 1);
  shear(2, 0) = random.uniform(-1, 1);
  map.linear() = map.linear() * scale.asDiagonal() * shear;
  map.translation() = 5 * random.point();
  return map;
}

/// The largest differences between hits, relative to the size of what they are compared with.
struct Differences {
  int hits = 0, lost = 0;
  double t = 0, position = 0, normal = 0, derivative = 0;

  void add(const std::optional<Hit>& hit, const std::optional<Hit>& expected, const Ray& ray, double side,
           double diagonal) {
    hits += expected.has_value();
    // Rounding moves a hit along a surface that the ray grazes.
    const auto cosine = [&](const Hit& h) { return std::abs(h.sample.normal.dot(ray.direction.normalized())); };
    if (hit.has_value() != expected.has_value()) {
      lost += cosine(hit ? *hit : *expected) > 1e-4;
      return;
    }
    if (!hit || cosine(*expected) < 0.05) return;
    t = std::max(t, std::abs(hit->t - expected->t) * ray.direction.norm() / diagonal);
    position = std::max(position, (hit->sample.position - expected->sample.position).norm() / diagonal);
    normal = std::max(normal, (hit->sample.normal - side * expected->sample.normal).norm());
    const auto &a = hit->sample.derivatives, &b = expected->sample.derivatives;
    if (!a || !b) return;
    for (const auto field : {&Derivatives::du, &Derivatives::dv})
      derivative = std::max(derivative, ((*a).*field - (*b).*field).norm() / diagonal);
  }
};

}  // namespace

TEST_CASE("An instance's hits are those of the transformed control mesh", "[intersect][instances]") {
  Random random(41);
  for (const Model& subject : instanced_models()) {
    const auto object = make_object(subject.mesh, subject.scheme);
    for (int round = 0; round < 6; ++round) {
      const bool mirrored = round % 2 == 1;
      CAPTURE(subject.name, round);
      const Affine map = random_map(random, mirrored);
      REQUIRE((map.linear().determinant() < 0) == mirrored);
      const ControlMesh twin = image_of(subject.mesh, map);
      const Scene scene({{object, map}}), expected(twin, subject.scheme);
      Differences differences;
      int occluded_differs = 0;
      for (const Ray& ray : random_rays(expected.bounds(), 300, 42)) {
        const auto hit = scene.intersect(ray);
        // The normal keeps its side; the twin's follows du x dv, which a mirror turns around.
        differences.add(hit, expected.intersect(ray), ray, mirrored ? -1 : 1, twin.diagonal());
        occluded_differs += scene.occluded(ray) != hit.has_value();
      }
      CHECK(differences.hits > 20);
      CHECK(differences.lost == 0);
      CHECK(differences.t < 1e-12);
      CHECK(differences.position < 1e-12);
      CHECK(differences.normal < 1e-9);
      CHECK(differences.derivative < 1e-9);
      CHECK(occluded_differs == 0);
    }
  }
}

TEST_CASE("A mirrored normal looks outward still", "[intersect][instances]") {
  Affine mirror = Affine::Identity();
  mirror.linear()(0, 0) = -1;
  const auto object = make_object(cube(), "catmark");
  for (const Affine& map : {Affine(Affine::Identity()), mirror}) {
    const Scene scene({{object, map}, {object, Affine(Eigen::Translation3d(9, 0, 0))}});
    const auto hit = scene.intersect({{0.2, 0.1, 5}, {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->sample.normal.z() > 0.5);
    const Vec3 across = hit->sample.derivatives->du.cross(hit->sample.derivatives->dv);
    CHECK((across.dot(hit->sample.normal) < 0) == (map.linear().determinant() < 0));
  }
}

TEST_CASE("Among many instances the nearest answers, with its index", "[intersect][instances]") {
  Random random(43);
  const std::vector<Model> all = instanced_models();
  std::vector<std::shared_ptr<const Object>> objects;
  for (const Model& subject : all) objects.push_back(make_object(subject.mesh, subject.scheme));
  std::vector<Instance> instances;
  std::vector<Scene> alone;
  for (int i = 0; i < 60; ++i) {
    Affine map = random_map(random, random.index(2) == 1);
    map.translation() = 12 * random.point();
    if (i == 7) map.setIdentity();
    instances.push_back({objects[static_cast<std::size_t>(random.index(static_cast<int>(objects.size())))], map});
    alone.emplace_back(std::vector<Instance>{instances.back()});
  }
  const Scene scene(instances);
  int hits = 0, wrong = 0, overlaps = 0;
  std::vector<Ray> rays = random_rays(scene.bounds(), 1500, 44);
  for (Ray& ray : rays) {
    if (random.index(2)) {
      ray.tmin = random.uniform(0, 1);
      ray.tmax = random.uniform(0.5, 1.5);
    }
    std::optional<Hit> nearest;
    int index = -1, met = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const auto hit = alone[i].intersect(ray);
      met += hit.has_value();
      if (!hit || (nearest && nearest->t <= hit->t)) continue;
      nearest = hit;
      index = static_cast<int>(i);
    }
    overlaps += met > 1;
    const auto hit = scene.intersect(ray);
    hits += hit.has_value();
    wrong += !same(hit, nearest) || (hit && hit->instance != index) || scene.occluded(ray) != hit.has_value();
  }
  CHECK(hits > 300);
  CHECK(overlaps > 100);
  CHECK(wrong == 0);

  std::vector<std::optional<Hit>> threaded(rays.size());
  const Scene fresh(instances);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = rays.size() - 1 - t; i < rays.size(); i -= 4) threaded[i] = fresh.intersect(rays[i]);
    });
  for (std::thread& thread : threads) thread.join();
  int differ = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hit = scene.intersect(rays[i]);
    differ += !same(hit, threaded[i]) || (hit && hit->instance != threaded[i]->instance);
  }
  CHECK(differ == 0);
}

TEST_CASE("Of instances in one place the first added answers", "[intersect][instances]") {
  Random random(45);
  const auto one = make_object(shaken(prism(5), 0.1), "catmark");
  const auto twin = make_object(shaken(prism(5), 0.1), "catmark");
  for (int round = 0; round < 10; ++round) {
    const Affine map = round == 0 ? Affine(Affine::Identity()) : random_map(random, round % 2 == 1);
    std::vector<Instance> instances;
    for (int i = 0; i < 20; ++i) instances.push_back({i % 2 ? one : twin, map});
    const Scene scene(instances);
    int hits = 0, wrong = 0;
    for (const Ray& ray : random_rays(scene.bounds(), 400, 46)) {
      const auto hit = scene.intersect(ray);
      hits += hit.has_value();
      wrong += hit && hit->instance != 0;
    }
    CAPTURE(round);
    CHECK(hits > 20);
    CHECK(wrong == 0);
  }
}

TEST_CASE("One instance under the identity is the object itself", "[intersect][instances]") {
  const ControlMesh mesh = shaken(torus("loop", 5, 7), 0.1);
  const Scene plain(mesh, "loop"), instance({{make_object(mesh, "loop")}});
  const Scene among(
      {{make_object(mesh, "loop")}, {make_object(cube(), "catmark"), Affine(Eigen::Translation3d(99, 0, 0))}});
  CHECK((plain.bounds().lower == instance.bounds().lower && plain.bounds().upper == instance.bounds().upper));
  int differ = 0;
  for (const Ray& ray : random_rays(plain.bounds(), 400, 47)) {
    const auto hit = plain.intersect(ray);
    differ += !same(hit, instance.intersect(ray)) || !same(hit, among.intersect(ray));
  }
  CHECK(differ == 0);
  CHECK(plain.statistics().bytes == instance.statistics().bytes);
}

TEST_CASE("Patches are shared by the instances of an object", "[intersect][instances]") {
  const auto object = make_object(prism(6), "catmark");
  std::vector<Instance> instances;
  for (int i = 0; i < 50; ++i) instances.push_back({object, Affine(Eigen::Translation3d(4.0 * i, 0, 0))});
  const Scene scene(instances);
  const auto shoot = [&](int i) { return scene.intersect({{4.0 * i + 0.3, 0.2, 9}, {0, 0, -1}}); };
  REQUIRE(shoot(0));
  const Statistics first = scene.statistics();
  CHECK(first.faces == 6 + 6 + 6);
  for (int i = 0; i < 50; ++i) {
    const auto hit = shoot(i);
    REQUIRE(hit);
    CHECK(hit->instance == i);
  }
  const Statistics all = scene.statistics();
  CHECK(all.bytes == first.bytes);
  CHECK(all.patches_split == first.patches_split);
  CHECK((all.rays == 51 && all.hits == 51));

  // Another scene's rays are not this one's, its patches are.
  const Scene other({{object}});
  CHECK(other.statistics().rays == 0);
  CHECK(other.statistics().patches_split == all.patches_split);
}

TEST_CASE("Directions keep their length: t is the same number under any scale", "[intersect][instances]") {
  const auto object = make_object(cube(), "catmark");
  for (const double scale : {1e-150, 1e-9, 3.0, 1e9, 1e150}) {
    Affine map = Affine::Identity();
    map.linear() *= scale;
    map.translation() = scale * Vec3(7, 0, 0);
    const Scene scene({{object, map}});
    const auto hit = scene.intersect({scale * Vec3(7.2, 0.1, 5), scale * Vec3(0, 0, -2), 0, 10});
    const auto plain = Scene(cube(), "catmark").intersect({{0.2, 0.1, 5}, {0, 0, -2}, 0, 10});
    CAPTURE(scale);
    REQUIRE(hit);
    CHECK(std::abs(hit->t - plain->t) < 1e-14);
    CHECK((hit->sample.normal - plain->sample.normal).norm() < 1e-14);
  }
}

TEST_CASE("The box of an image holds the image", "[intersect][instances]") {
  Random random(48);
  int outside = 0;
  double loosest = 0;
  for (int round = 0; round < 2000; ++round) {
    Affine map = random_map(random, round % 2 == 1);
    map.translation() *= std::exp2(random.uniform(-20, 40));
    Box box;
    for (int i = 0; i < 2; ++i) box.add(Vec3(std::exp2(random.uniform(-20, 20)) * random.point()));
    const Box image = transformed(box, map);
    using Exact = Eigen::Matrix<long double, 3, 1>;
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis) point[axis] = (corner >> axis & 1 ? box.upper : box.lower)[axis];
      const Exact exact =
          map.linear().cast<long double>() * point.cast<long double>() + map.translation().cast<long double>();
      outside += (exact.array() < image.lower.cast<long double>().array()).any() ||
                 (exact.array() > image.upper.cast<long double>().array()).any();
    }
    const Vec3 extent = map.linear().cwiseAbs() * (box.upper - box.lower);
    loosest =
        std::max(loosest, ((image.upper - image.lower - extent).cwiseAbs().maxCoeff()) / image.largest_coordinate());
  }
  CHECK(outside == 0);
  CHECK(loosest < 1e-13);
  CHECK((transformed(Box{}, random_map(random, false)).lower.array() > 0).all());
}

TEST_CASE("Transforms that cannot be used are refused by instance", "[intersect][instances]") {
  const auto object = make_object(cube(), "catmark");
  const auto refuse = [&](const Affine& map) { return refusal_of([&] { Scene({{object}, {object, map}}); }); };
  Affine map = Affine::Identity();
  map.linear() << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  CHECK(refuse(map).find("instance 1: the transform is singular to rounding") == 0);
  map.setIdentity();
  map.linear()(1, 1) = 0;
  CHECK(refuse(map).find("instance 1: the transform is singular: its linear part has a row of size 0") == 0);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const int column : {0, 3}) {
      map.setIdentity();
      map.matrix()(2, column) = bad;
      CHECK(refuse(map).find("instance 1: the transform has an entry that is not finite") == 0);
    }
  map.setIdentity();
  map.translation().x() = std::numeric_limits<double>::max();
  map.linear() *= 1e308;
  CHECK(refuse(map).find("instance 1: ") == 0);
  CHECK(refusal_of([&] { Scene({{object}, {nullptr}}); }).find("instance 1: has no object") == 0);
  CHECK(refusal_of([&] { Scene({{object}}).surface(1); }).find("there is no instance 1") == 0);

  // Uneven, not singular.
  map.setIdentity();
  map.linear().diagonal() = Vec3(1e-12, 1, 1e12);
  CHECK(refuse(map) == "no error");
}

TEST_CASE("Scenes of nothing answer nothing", "[intersect][instances]") {
  const Scene empty{std::vector<Instance>{}};
  CHECK(!empty.intersect({{0, 0, 5}, {0, 0, -1}}));
  CHECK(!empty.occluded({{0, 0, 5}, {0, 0, -1}}));
  CHECK(empty.statistics().rays == 2);
  ControlMesh hole = sheet("catmark", 1, 1);
  hole.holes = {0};
  const auto nothing = make_object(hole, "catmark");
  const Scene scene({{nothing}, {make_object(cube(), "catmark"), Affine(Eigen::Translation3d(0, 0, 3))}, {nothing}});
  const auto hit = scene.intersect({{0.1, 0, 9}, {0, 0, -1}});
  REQUIRE(hit);
  CHECK(hit->instance == 1);
  CHECK(scene.bounds().lower.z() > 0);
}

// Sheets side by side on a grid whose numbers are exact: rays through the common sides and corners.
TEST_CASE("No ray slips through between instances that abut", "[intersect][instances]") {
  Random random(49);
  const auto object = make_object(sheet("catmark", 2, 2), "catmark");
  std::vector<Instance> instances;
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) instances.push_back({object, Affine(Eigen::Translation3d(2 * i, 2 * j, 0))});
  const Scene scene(instances);
  int lost = 0;
  for (int i = 0; i < 5000; ++i) {
    const double along = random.uniform(1, 15);
    const Vec3 target(2 * (1 + random.index(7)), i % 10 ? along : std::round(along / 2) * 2, 0);
    const Vec3 direction = random.direction();
    if (std::abs(direction.z()) < 0.05) continue;
    lost += !scene.intersect({target - 8 * direction, direction});
  }
  CHECK(lost == 0);
}

}  // namespace shaolin
