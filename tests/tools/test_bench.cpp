/// `bench`: what it measures by.
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/tools/cli_run.h"
#include "tools/bench/error_figures.h"
#include "tools/bench/measure.h"
#include "tools/bench/paper_figures.h"
#include "tools/bench/peak_memory.h"
#include "tools/bench/silhouette_band.h"
#include "tools/bench/thread_stopwatch.h"
#include "tools/cli/csv.h"
#include "tools/cli/json_text.h"
#include "tools/validate/quad_oracle.h"

namespace shaolin::test {
namespace {

/// The square [-1, 1] x [-1, 1] in the plane z = 0, seen from above.
Scene plate() {
  ControlMesh mesh = mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2, 3}});
  return Scene(std::move(mesh), "bilinear");
}

Ray down(double x, double y) {
  Ray ray;
  ray.origin = {x, y, 5};
  ray.direction = {0, 0, -2};
  return ray;
}

}  // namespace

TEST_CASE("The silhouette band explains what a shift across the ray does, and nothing else", "[tools][bench]") {
  const Scene scene = plate();
  const double width = 0.1;
  const auto band = [&](double x) { return silhouette_band(scene, down(x, 0.2), width); };
  // Inside: hits at a distance of 5, whichever way; a miss is not explained, nor is a hit far before or behind.
  CHECK_FALSE(band(0).any_miss);
  CHECK(band(0).nearest == Approx(5));
  CHECK(band(0).farthest == Approx(5));
  CHECK(band(0).explains(5.05, width));
  CHECK_FALSE(band(0).explains(5.2, width));
  CHECK_FALSE(band(0).explains(std::nullopt, width));
  // A little less than the width from the rim, on either side of it; then a little more.
  for (const double x : {0.901, 1.099}) {
    CHECK(band(x).explains(5.0, width));
    CHECK(band(x).explains(std::nullopt, width));
  }
  CHECK_FALSE(band(0.899).explains(std::nullopt, width));
  CHECK_FALSE(band(1.101).explains(5.0, width));
  // Only past the rim is anything let through, and only by the plate is anything near.
  CHECK(band(0.901).lets_through(7, width));
  CHECK_FALSE(band(0.899).lets_through(7, width));
  CHECK(band(0.899).lets_through(5.05, width));
  const Ray ray = down(0, 0.2);
  const Vec3 along = ray.direction.normalized();
  for (const double off : {-0.09, 0.09}) CHECK(is_near(scene, ray.origin + (5 + off) * along, along, width));
  for (const double off : {-0.11, 0.11}) CHECK_FALSE(is_near(scene, ray.origin + (5 + off) * along, along, width));
}

TEST_CASE("Two sheets that a ray grazes from opposite sides are missed each by itself", "[tools][bench]") {
  // Seen from above they overlap by 0.02, and no more if they are one folded sheet.
  const std::vector<Vec3> points{{-1, -1, 0},     {0.01, -1, 0}, {0.01, 1, 0}, {-1, 1, 0},
                                 {-0.01, -1, -2}, {1, -1, -2},   {1, 1, -2},   {-0.01, 1, -2}};
  const Scene two(mesh_of(points, {{0, 1, 2, 3}, {4, 5, 6, 7}}), "bilinear");
  const Scene folded(mesh_of(points, {{0, 1, 2, 3}, {2, 1, 4, 7}, {4, 5, 6, 7}}), "bilinear");
  const Ray ray = down(0, 0.2);  // meets z = 0 at a distance of 5, -2 at 7
  const double width = 0.1;
  for (const Scene* scene : {&two, &folded}) {
    const SilhouetteBand band = silhouette_band(*scene, ray, width);
    CHECK_FALSE(band.explains(std::nullopt, width));
    CHECK_FALSE(band.lets_through(8, width));
    CHECK(leads_past(*scene, ray, width) == (scene == &two));
    CHECK(leads_past(*scene, ray, width, 8) == (scene == &two));
    CHECK(leads_past(*scene, ray, width, 6));
  }
  CHECK(leads_past(two, ray, 0.011));
  CHECK_FALSE(leads_past(two, ray, 0.009));
  CHECK_FALSE(leads_past(plate(), ray, width));
  CHECK(leads_past(plate(), ray, width, 5.05));

  // An interval that is shorter than two widths may end before its chords begin.
  Ray brief = ray;
  for (const double half : {0.04, 0.06}) {  // in units of the direction's length, 2
    brief.tmin = 2.5 - half, brief.tmax = 2.5 + half;
    CHECK(leads_past(plate(), brief, width) == (half < 0.05));
  }

  const Contender chords{.kind = ContenderKind::chord, .chord = {.epsilon = 0.05, .min_size = 0}};  // a band of 0.1
  const std::vector<Ray> rays{ray};
  const Answers lost(1);
  CHECK(compare(chords, two, rays, trace(rays, two), lost).lost_outside == 0);
  CHECK(compare(chords, folded, rays, trace(rays, folded), lost).lost_outside == 1);
}

TEST_CASE("The band's width is that of epsilon or of the smallest patch that is refined", "[tools][bench]") {
  const ChordOptions options{.epsilon = 0.03, .min_size = 2};
  CHECK(band_width(options, {}, 7) == Approx(0.06));
  CHECK(band_width(options, {.width = 0.1, .growth = 0.01}, 7) == Approx(2 * 2 * 0.17));
}

TEST_CASE("Answers that are wrong are found, in the band and outside", "[tools][bench]") {
  const Scene scene = plate();
  const Contender chords{.kind = ContenderKind::chord, .chord = {.epsilon = 0.05, .min_size = 0}};  // a band of 0.1
  const std::vector<Ray> rays{down(0, 0), down(0.3, 0.1), down(0.95, 0), down(1.05, 0), down(3, 0), down(0.5, 0.5)};
  const Answers expected = trace(rays, scene);
  REQUIRE(expected[0]);
  REQUIRE_FALSE(expected[3]);
  CHECK(compare(chords, scene, rays, expected, expected).lost_outside == 0);

  Answers wrong = expected;
  wrong[0].reset();                    // lost in the middle
  wrong[1]->t += 0.5;                  // farther by 1 (the direction's length is 2)
  wrong[2].reset();                    // lost at the rim
  wrong[3] = wrong[4] = *expected[5];  // ghosts: beside the rim, and in nothing
  wrong[5]->normal = {0, std::sin(0.25), std::cos(0.25)};
  const ErrorFigures figures = compare(chords, scene, rays, expected, wrong);
  CHECK(figures.rays == 6);
  CHECK(figures.hits == 4);
  CHECK(figures.lost == 2);
  CHECK(figures.farther == 1);
  CHECK(figures.nearer == 0);
  CHECK(figures.ghosts == 2);
  CHECK(figures.lost_outside == 2);  // of lost and farther
  CHECK(figures.ghosts_outside == 1);
  CHECK(figures.outside.size() == 3);
  CHECK(figures.distance.max == Approx(1));
  CHECK(figures.normal.max == Approx(0.25));
}

TEST_CASE("Rays that one of two methods stops are lost or ghosts", "[tools][bench]") {
  const HitFigures figures = compare(Occlusions{1, 1, 1, 0, 0, 1}, Occlusions{1, 0, 0, 1, 0, 1});
  CHECK(figures.rays == 6);
  CHECK(figures.hits == 4);
  CHECK(figures.lost == 2);
  CHECK(figures.ghosts == 1);
  CHECK(figures.own_hits() == 3);
}

TEST_CASE("Quantiles and spreads", "[tools][bench]") {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const Quantiles of = quantiles(values);
  CHECK(of.median == 50);
  CHECK(of.p99 == 99);
  CHECK(of.max == 100);
  CHECK(spread({3, 1}).median == 2);
  CHECK(spread({5, 1, 3}).median == 3);
  CHECK(spread({5, 1, 3}).least == 1);
  CHECK(spread({5, 1, 3}).most == 5);
  LevelCounts counts;
  for (const int level : {1, 3, 3, 40}) counts.add(level);
  CHECK(counts.total() == 4);
  CHECK(counts.mean() == Approx((1 + 3 + 3 + 15) / 4.0));
}

TEST_CASE("The paper's tables add up to its means", "[tools][bench]") {
  for (const PaperScene& scene : paper_scenes())
    for (const PaperLevels& row : scene.levels) {
      double hits = 0, sum = 0;
      for (std::size_t i = 0; i < row.hits.size(); ++i) {
        hits += row.hits[i];
        sum += static_cast<double>(i + 1) * row.hits[i];
      }
      CAPTURE(scene.title, row.epsilon);
      CHECK(std::abs(sum / hits - row.mean) < 0.011);
    }
}

TEST_CASE("Random rays aim at the scene, ambient rays leave the side that is seen", "[tools][bench]") {
  const Subject subject(load_stage({data_file("torus.obj"), {}, {}}), {20, 20}, WarmRays::random_and_ambient_too);
  const Workload& work = subject.work;
  REQUIRE(work.random.size() == 400);
  const Box box = subject.exact.bounds();
  for (const Ray& ray : work.random) {
    CHECK((ray.origin - box.centre()).norm() == Approx(subject.diagonal));
    CHECK(ray.direction.norm() == Approx(1));
    CHECK(ray.footprint.growth == work.primary.front().footprint.growth);
  }
  std::size_t hits = 0;
  for (const auto& answer : subject.primary) hits += answer.has_value();
  REQUIRE(work.ambient.size() == hits);
  std::size_t next = 0;
  double cosines = 0;
  for (std::size_t i = 0; i < work.primary.size(); ++i) {
    if (!subject.primary[i]) continue;
    const Ray &primary = work.primary[i], &ambient = work.ambient[next++];
    const Vec3 normal = subject.primary[i]->normal;
    const double cosine = ambient.direction.dot(normal) * (normal.dot(primary.direction) <= 0 ? 1 : -1);
    CHECK(cosine >= 0);
    CHECK(ambient.tmax == Approx(subject.diagonal / 20));
    cosines += cosine;
  }
  // The mean by the cosine is 2/3, its deviation sqrt(1/18 / hits).
  CHECK(std::abs(cosines / static_cast<double>(hits) - 2.0 / 3) < 4 * std::sqrt(1.0 / 18 / static_cast<double>(hits)));
}

TEST_CASE("A thread's stopwatch counts work, and not rest", "[tools][bench]") {
  ThreadStopwatch stopwatch;
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  CHECK(stopwatch.lap() < 0.02);
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
  while (std::chrono::steady_clock::now() < end) {
  }
  const double worked = stopwatch.lap();
  CHECK(worked > 0.005);  // others may have had the rest
  CHECK(worked < 0.25);
}

TEST_CASE("Peak memory includes what is freed again", "[tools][bench]") {
  const std::size_t size = std::size_t{64} << 20;
  const PeakMemory memory;
  { const std::vector<char> held(size, 1); }
  CHECK(memory.growth() > size - size / 16);  // the system counts pages in batches
  CHECK(PeakMemory().growth() < size / 2);
}

// Regular patches, and rounded corners, n-gons, creases, darts and points near irregular vertices.
TEST_CASE("Refinement in quadruple precision finds the limit", "[tools][bench]") {
  Random random(11);
  for (const std::string name : {"torus.obj", "ngon_body.obj", "cube_creases.obj", "dart.obj", "loop_torus.obj"}) {
    const LoadedModel model = load_model({data_file(name), {}, {}});
    const QuadOracle oracle(model.mesh, model.scheme);
    const auto surface = make_limit_surface(model.mesh, model.scheme);
    for (int i = 0; i < 12; ++i) {
      const int face = random.index(surface->face_count()), sub = random.index(surface->sub_count(face));
      const double u = random.uniform(0, i % 3 == 0 ? 1e-3 : 0.5), v = random.uniform(0, 0.5);
      const SurfaceParameter at{face, sub, u, v};
      const auto sample = surface->evaluate(at);
      if (!sample) continue;
      CAPTURE(name, face, sub, at.u, at.v);
      const QuadVec3 difference = oracle.position(at) - sample->position.cast<Quad>();
      CHECK(static_cast<double>(difference.norm()) < 1e-15 * oracle.diagonal());
    }
  }
}

// A pyramid of n faces around vertex 0 at z = 1, the rest at z = 0 but vertex 1 at z = 1: the limit weighs the vertex
// 1 - n w and its neighbours w = 1 / (n + 3 / (8 beta)), which no double holds.
TEST_CASE("Refinement in quadruple precision has more digits than double", "[tools][bench]") {
  for (const int n : {5, 6}) {
    std::vector<Vec3> points{{0, 0, 1}};
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * i / n;
      points.emplace_back(std::cos(angle), std::sin(angle), i == 0 ? 1 : 0);
      faces.push_back({0, 1 + i, 1 + (i + 1) % n});
    }
    const QuadVec3 limit = QuadOracle(mesh_of(points, faces), "loop").position({0, 0, 0, 0});
    const Quad cosine = n == 6 ? Quad(1) / 2 : (sqrt(Quad(5)) - 1) / 4;  // of 2 pi / n
    const Quad root = Quad(3) / 8 + cosine / 4, beta = (Quad(5) / 8 - root * root) / n;
    const Quad weight = 1 / (n + 3 / (8 * beta));
    CAPTURE(n);
    CHECK(static_cast<double>(abs(limit.z() - (1 - n * weight + weight))) < 1e-25);
  }
}

}  // namespace shaolin::test
