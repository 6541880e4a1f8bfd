// Faces are picked where brute force finds a point of them, and where a region just reaches them.
#include <set>

#include "intersect/scene.h"
#include "tests/catch.h"
#include "tests/intersect/refusal.h"
#include "tests/intersect/shape_models.h"
#include "tools/validate/dense_sampling.h"

namespace shaolin {

namespace {

bool holds(const Frustum& frustum, const Vec3& p) {
  return std::all_of(frustum.sides.begin(), frustum.sides.end(),
                     [&](const HalfSpace& side) { return side.normal.dot(p) <= side.offset; });
}

/// What an eye outside sees through a window near the surface, wide or as narrow as a pixel.
Frustum random_view(const Box& box, const Vec3& at, Random& random) {
  const Vec3 size = box.upper - box.lower, eye = box.centre() + size.norm() * random.direction();
  const Vec3 forward = (at - eye).normalized(), right = forward.unitOrthogonal(), up = right.cross(forward);
  const double width = std::exp2(random.uniform(-12, -2)), height = std::exp2(random.uniform(-12, -2));
  return Frustum::of_view(eye, {forward - width * right - height * up, forward + width * right - height * up,
                                forward + width * right + height * up, forward - width * right + height * up});
}

/// All within so far of some planes through a point: wedges, slabs, half-spaces.
Frustum random_region(const Box& box, const Vec3& at, Random& random) {
  Frustum region;
  const int count = 1 + random.index(6);
  for (int i = 0; i < count; ++i) {
    const Vec3 normal = random.uniform(0.1, 3) * random.direction();
    region.sides.push_back({normal, normal.dot(at) + 0.05 * random.uniform() * (box.upper - box.lower).norm()});
  }
  return region;
}

std::set<int> faces_of(const std::vector<PickedFace>& picked) {
  std::set<int> faces;
  for (const PickedFace& one : picked) faces.insert(one.face);
  return faces;
}

/// Picks hold every face of which a sample is in the region; and of each other face that they hold, a point is near:
/// the region, moved outward by a millionth, holds a sample of a finer net, or the face is asked alone.
void check_picks_against_brute_force(const Model& model, int count, int steps) {
  const Scene scene(model.mesh, model.scheme);
  const DenseSampling samples(scene.surface(), steps);
  Random random(41);
  int missed = 0, picked_in_all = 0;
  std::uint64_t most = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 at =
        samples.samples()[static_cast<std::size_t>(random.index(static_cast<int>(samples.samples().size())))].position;
    const Frustum region = i % 2 ? random_view(scene.bounds(), at, random) : random_region(scene.bounds(), at, random);
    const std::uint64_t before = scene.statistics().cells;
    const auto picked = scene.pick(region);
    most = std::max(most, (scene.statistics().cells - before) / (picked.size() + 10));
    CHECK(std::is_sorted(picked.begin(), picked.end()));
    const std::set<int> faces = faces_of(picked);
    CHECK(faces.size() == picked.size());
    picked_in_all += static_cast<int>(faces.size());
    for (const auto& sample : samples.samples())
      missed += holds(region, sample.position) && !faces.contains(sample.at.face);
    CHECK(!faces.empty());  // the point that it is about is on the surface
  }
  CAPTURE(model.name, model.scheme, picked_in_all, most);
  CHECK(missed == 0);
  CHECK(most < 2000);
}

}  // namespace

TEST_CASE("Faces are picked where brute force finds them", "[intersect][pick]") {
  for (const Model& model : shape_models()) check_picks_against_brute_force(model, 10, 6);
}

TEST_CASE("Faces are picked where brute force finds them: all models", "[intersect][pick][sweep]") {
  for (const Model& model : shape_models()) check_picks_against_brute_force(model, 30, 6);
  for (const Model& model : all_models()) {
    const Scene scene(model.mesh, model.scheme);
    if ((scene.bounds().lower.array() > scene.bounds().upper.array()).any()) continue;
    check_picks_against_brute_force(model, 60, model.mesh.face_count() > 1500 ? 3 : 6);
  }
}

TEST_CASE("A half-space picks a face if and only if it reaches its lowest point", "[intersect][pick]") {
  Random random(42);
  for (const Model& model : shape_models()) {
    const Scene scene(model.mesh, model.scheme);
    const DenseSampling samples(scene.surface(), 8);
    const double diagonal = model.mesh.diagonal();
    for (int i = 0; i < 6; ++i) {
      const Vec3 n = random.direction();
      // The lowest point along n is the one that is nearest to a point far down: to some diagonal^2 / distance.
      const double distance = 1e5 * diagonal;
      const auto lowest = scene.closest_point(scene.bounds().centre() - distance * n);
      const double least = n.dot(lowest->sample.position);
      CAPTURE(model.name, i);
      CHECK(scene.pick({{{n, least - 1e-4 * diagonal}}}).empty());
      CHECK(!scene.pick({{{n, least + 1e-13 * diagonal}}}).empty());
      // A few faces share it at most; all that do are picked with it.
      const auto picked = faces_of(scene.pick({{{n, least + 0.1 * diagonal}}}));
      for (const auto& sample : samples.samples())
        if (n.dot(sample.position) < least + 0.1 * diagonal) CHECK(picked.contains(sample.at.face));
      int above = 0;
      for (const int face : picked) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& sample : samples.samples())
          if (sample.at.face == face) nearest = std::min(nearest, n.dot(sample.position));
        above += nearest > least + 0.15 * diagonal;
      }
      CHECK(above == 0);
    }
  }
}

TEST_CASE("A region that just reaches a face, or just fails to, over a side, an edge and a corner",
          "[intersect][pick]") {
  const Scene scene(cube(), "catmark");
  const Vec3 top = scene.closest_point({0, 0, 9})->sample.position;
  for (const double gap : {1e-3, 1e-9, 1e-12, -1e-12, -1e-9, -1e-3}) {
    const Vec3 tip = top + gap * Vec3::UnitZ();
    Frustum side, edge, corner;
    side.sides = {{-Vec3::UnitZ(), -tip.z()}};
    edge.sides = {{Vec3(1, 0, -1), -tip.z()}, {Vec3(-1, 0, -1), -tip.z()}};
    corner.sides = {{Vec3(1, 0, -1), -tip.z()}, {Vec3(-1, 1, -1), -tip.z()}, {Vec3(-1, -1, -1), -tip.z()}};
    for (const Frustum& region : {side, edge, corner}) {
      const std::uint64_t before = scene.statistics().cells;
      const auto picked = scene.pick(region);
      CAPTURE(gap, region.sides.size());
      CHECK(picked.empty() == (gap > 0));
      CHECK(scene.statistics().cells - before < 10000);
    }
  }
}

TEST_CASE("Picks of instances are those of the mapped mesh", "[intersect][pick][instances]") {
  Random random(43);
  const ControlMesh mesh = shaken(cube(), 0.2);
  const auto object = make_object(mesh, "catmark");
  for (int k = 0; k < 10; ++k) {
    const Affine one = random_affine(random), two = random_affine(random);
    const Scene both(std::vector<Instance>{{object, one}, {object, two}});
    const Scene first(image_of(mesh, one), "catmark"), second(image_of(mesh, two), "catmark");
    for (int i = 0; i < 20; ++i) {
      const Vec3 at =
          both.bounds().centre() + 0.3 * (both.bounds().upper - both.bounds().lower).cwiseProduct(random.point());
      const Frustum region = random_view(both.bounds(), at, random);
      std::vector<PickedFace> expected = first.pick(region);
      for (const PickedFace& face : second.pick(region)) expected.push_back({1, face.face});
      CHECK(both.pick(region) == expected);
    }
  }
}

TEST_CASE("Regions without a point pick nothing; what is none is refused", "[intersect][pick]") {
  const Scene scene(cube(), "catmark");
  const Frustum nothing{{{Vec3::UnitX(), -1}, {-Vec3::UnitX(), -1}}}, all{{{Vec3::UnitX(), 1e9}}};
  CHECK(scene.pick(nothing).empty());
  CHECK(scene.pick(all).size() == 6);
  CHECK(scene.statistics().faces_touched == 0);  // all are inside: their boxes were enough
  CHECK(Scene(std::vector<Instance>{}).pick(all).empty());
  const double nan = std::nan("");
  CHECK(refusal_of([&] { scene.pick({}); }).find("no sides") != std::string::npos);
  CHECK(refusal_of([&] { scene.pick({{{Vec3::Zero(), 1}}}); }).find("is zero") != std::string::npos);
  CHECK(refusal_of([&] { scene.pick({{{Vec3(1, nan, 0), 1}}}); }).find("not finite") != std::string::npos);
  CHECK(refusal_of([&] { scene.pick({{{Vec3::UnitX(), nan}}}); }).find("not finite") != std::string::npos);
  CHECK(refusal_of([&] { Frustum::of_view({0, 0, 0}, {{1, 0, 0}, {0, 1, 0}}); }).find("corners") != std::string::npos);
  CHECK(refusal_of([&] {
          Frustum::of_view({0, 0, 0}, {{1, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        }).find("span no plane") != std::string::npos);
}

}  // namespace shaolin
