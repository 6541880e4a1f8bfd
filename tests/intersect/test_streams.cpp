// Many rays at once: the answers are those of single rays, whatever the order and the number of threads.
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "intersect/ray_order.h"
#include "schemes/errors.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

TEST_CASE("A stream of rays is answered as each ray alone is", "[intersect][streams][sweep]") {
  for (const int threads : {1, 2, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    for (const Model& model : all_models()) {
      CAPTURE(model.name, threads);
      const Scene many(model.mesh, model.scheme), single(model.mesh, model.scheme);
      const std::vector<Ray> rays = random_rays(many.bounds(), 300, 7);
      const auto hits = many.intersect(rays);
      const auto met = many.occluded(rays);
      REQUIRE(hits.size() == rays.size());
      REQUIRE(met.size() == rays.size());
      std::size_t differing = 0, hit_count = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        differing += !same(hits[i], single.intersect(rays[i])) || (met[i] != 0) != single.occluded(rays[i]);
        hit_count += hits[i].has_value();
      }
      CHECK(differing == 0);
      CHECK(many.statistics().rays == 2 * rays.size());
      CHECK(many.statistics().hits >= hit_count);
    }
  }
}

TEST_CASE("A stream may be empty, and its first bad ray is named before any is traced", "[intersect][streams]") {
  const Scene scene(sheet("catmark", 4, 4), "catmark");
  CHECK(scene.intersect(std::span<const Ray>()).empty());
  CHECK(scene.occluded(std::span<const Ray>()).empty());
  std::vector<Ray> rays(5, Ray{{1, 1, 2}, {0, 0, -1}});
  rays[3].direction.setZero();
  rays[4].origin.x() = std::numeric_limits<double>::quiet_NaN();
  const auto message = [&](auto query) -> std::string {
    try {
      query();
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const std::string expected = "ray 3: ray direction is zero; expected a direction of any other length";
  CHECK(message([&] { scene.intersect(rays); }) == expected);
  CHECK(message([&] { scene.occluded(rays); }) == expected);
  CHECK(scene.statistics().rays == 0);
}

TEST_CASE("The order of a stream takes each ray once, and brings together what is alike", "[intersect][streams]") {
  const Box box{Vec3(0, 0, 0), Vec3(1, 1, 1)};
  // Two bundles in turns, and rays that miss the box.
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i) {
    const double x = 0.3 + 1e-3 * i / 300;
    if (i % 3 == 0)
      rays.push_back({{x, 0.3, 2}, {0, 0, -1}});
    else if (i % 3 == 1)
      rays.push_back({{0.8, x + 0.4, -2}, {0, 0, 1}});
    else
      rays.push_back({{x, 5, 2}, {0, 0, -1}});
  }
  std::vector<std::uint32_t> order = coherent_order(rays, box);
  for (std::size_t i = 0; i < 300; ++i) CHECK(order[i] % 3 == (i < 100 ? 1 : i < 200 ? 0 : 2));
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(300);
  std::iota(all.begin(), all.end(), 0u);
  CHECK(order == all);

  // A picture, line by line, keeps its order; the same rays shuffled do not.
  std::vector<Ray> picture;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) picture.push_back({{0.5, 0.5, 3}, {(x - 19.5) / 50, (y - 19.5) / 50, -2.5}});
  const auto is_kept = [&] {
    const std::vector<std::uint32_t> kept = coherent_order(picture, box);
    return std::is_sorted(kept.begin(), kept.end());
  };
  CHECK(is_kept());
  Random random(7);
  for (std::size_t i = picture.size() - 1; i > 0; --i)
    std::swap(picture[i], picture[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
  CHECK_FALSE(is_kept());
  CHECK(coherent_order({}, box).empty());

  // Numbers of all sizes have some place.
  constexpr double huge = std::numeric_limits<double>::max();
  const std::vector<Ray> odd{{{huge, -huge, huge}, {-huge, huge, 1e-300}, -huge, huge}, {{0.5, 0.5, 0.5}, {1, 0, 0}}};
  CHECK(coherent_order(odd, box).size() == 2);
  CHECK(coherent_order(odd, Box{}).size() == 2);
  CHECK(coherent_order(odd, Box{Vec3(0, 0, 0), Vec3(1, 1, 0)}).size() == 2);
}

}  // namespace shaolin
