#include "tools/bench/closest.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <span>
#include <string>

#include "intersect/scene.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"
#include "tools/bench/thread_stopwatch.h"
#include "tools/bench/triangle_tree.h"
#include "tools/cli/command.h"
#include "tools/cli/threads.h"
#include "tools/validate/dense_sampling.h"
#include "tools/validate/random.h"

namespace shaolin {
namespace {

constexpr double wrong_beyond = 1e-12;  ///< of the diagonal

struct ClosestSubject {
  std::string name, scheme;
  ControlMesh mesh;
  Scene scene;
  double diagonal;

  ClosestSubject(const std::filesystem::path& file, ControlMesh control)
      : name(file.stem().string()),
        scheme(default_scheme(control)),
        mesh(std::move(control)),
        scene(mesh, scheme),
        diagonal((scene.bounds().upper - scene.bounds().lower).norm()) {}
};

/// Point `number` of those that a seed gives: by a generator of its own, so that threads need no order. (Seeds are
/// apart by the odd number nearest to 2^64 over the golden ratio, as in SplitMix; Steele, Lea, Flood 2014.)
Vec3 random_point(const ClosestSubject& subject, const DenseSampling& samples, std::uint64_t seed, std::size_t number) {
  SampleRandom random(seed * 0x9e3779b97f4a7c15u + number);
  const Box box = subject.scene.bounds();
  switch (number % 3) {
    case 0: {
      const auto& at = samples.samples()[random.index(samples.samples().size())];
      const double away = random.log_between(1e-8, 1e-1) * subject.diagonal;
      return at.position + away * random.direction();
    }
    case 1:
      return random.inside(box.lower, box.upper);
    default:
      const Vec3 size = box.upper - box.lower;
      return random.inside(box.lower - size, box.upper + size);
  }
}

struct WrongPoint {
  Vec3 point;
  double by;  ///< in diagonals
};

/// What brute force says of the first points.
struct CheckedPoints {
  std::size_t count = 0;
  double worst = 0;  ///< in diagonals: farther than brute force, or off the surface
  std::vector<WrongPoint> wrong;
};

CheckedPoints check_points(const ClosestSubject& subject, const DenseSampling& samples,
                           const ClosestBenchOptions& options) {
  CheckedPoints checked;
  std::mutex mutex;
  const LimitSurface& surface = subject.scene.surface();
  const auto check = [&](std::size_t number) {
    const Vec3 point = random_point(subject, samples, options.seed, number);
    const std::optional<ClosestPoint> closest = subject.scene.closest_point(point);
    double by = std::numeric_limits<double>::infinity();
    if (closest) {
      const Vec3 position = surface.evaluate(closest->at)->position;
      by = std::max({closest->distance - samples.distance(point), (position - closest->sample.position).norm(),
                     std::abs((position - point).norm() - closest->distance)}) /
           subject.diagonal;
    }
    const std::lock_guard lock(mutex);
    ++checked.count;
    checked.worst = std::max(checked.worst, by);
    if (!(by <= wrong_beyond)) checked.wrong.push_back({point, by});
  };
  run_with_threads(options.threads,
                   [&] { tbb::parallel_for(std::size_t{0}, options.checked, [&](std::size_t i) { check(i); }); });
  std::sort(checked.wrong.begin(), checked.wrong.end(), [](const auto& a, const auto& b) { return a.by > b.by; });
  return checked;
}

/// A tree over triangles that are as fine as they must be, or may be.
struct FineTriangles {
  int level = 0;
  std::size_t count = 0;
  double error = 0;  ///< the largest of distances from points, in diagonals
  std::unique_ptr<const TriangleTree> tree;
};

FineTriangles fine_triangles(const ClosestSubject& subject, std::span<const Vec3> points,
                             const ClosestBenchOptions& options) {
  std::vector<double> distances;
  for (const Vec3& point : points) distances.push_back(subject.scene.closest_point(point)->distance);
  FineTriangles fine;
  for (fine.level = 1;; ++fine.level) {
    const TriangleSoup soup = uniform_triangles(subject.mesh, subject.scheme, fine.level);
    fine.count = soup.triangles.size();
    fine.tree = std::make_unique<const TriangleTree>(soup);
    fine.error = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = (fine.tree->closest(points[i]) - points[i]).norm();
      fine.error = std::max(fine.error, std::abs(distance - distances[i]) / subject.diagonal);
    }
    if (fine.error <= options.error || 4 * fine.count > options.most_triangles) return fine;
  }
}

/// Seconds of a run over all points, a thousand by each in turn.
struct ClosestLap {
  double ours = 0, theirs = 0;
};

ClosestLap time_in_turns(const Scene& scene, const TriangleTree& tree, std::span<const Vec3> points) {
  constexpr std::size_t chunk = 1000;
  ClosestLap lap;
  double sum = 0;  // of what is asked, so that it is
  for (std::size_t first = 0; first < points.size(); first += chunk) {
    const auto part = points.subspan(first, std::min(chunk, points.size() - first));
    ThreadStopwatch stopwatch;
    for (const Vec3& point : part) sum += scene.closest_point(point)->distance;
    lap.ours += stopwatch.lap();
    for (const Vec3& point : part) sum -= (tree.closest(point) - point).norm();
    lap.theirs += stopwatch.lap();
  }
  if (!std::isfinite(sum)) throw std::runtime_error("closest points are infinitely far");
  return lap;
}

/// False if anything is wrong.
bool bench_model(const std::filesystem::path& file, const ClosestBenchOptions& options) {
  const ClosestSubject subject(file, read_obj(file));
  if (subject.scheme != "loop" && subject.scheme != "catmark")
    throw InputError(file.string() + ": is of the scheme " + subject.scheme +
                     "; triangles are those of loop or catmark");
  constexpr int steps = 5;
  const DenseSampling samples(subject.scene.surface(), steps);
  if (samples.samples().empty()) throw InputError(file.string() + ": has no limit surface");
  const CheckedPoints checked = check_points(subject, samples, options);

  std::vector<Vec3> points;
  for (std::size_t i = 0; i < options.queries; ++i)
    points.push_back(random_point(subject, samples, options.seed, options.checked + i));
  constexpr std::size_t held_against = 2000;
  const FineTriangles fine =
      fine_triangles(subject, std::span(points).first(std::min(held_against, points.size())), options);
  std::vector<double> ours, theirs, ratio;
  time_in_turns(subject.scene, *fine.tree, points);  // warm
  for (int run = 0; run < options.runs; ++run) {
    const ClosestLap lap = time_in_turns(subject.scene, *fine.tree, points);
    ours.push_back(1e-3 * static_cast<double>(points.size()) / lap.ours);
    theirs.push_back(1e-3 * static_cast<double>(points.size()) / lap.theirs);
    ratio.push_back(lap.theirs / lap.ours);
  }
  for (std::vector<double>* const figures : {&ours, &theirs, &ratio}) std::sort(figures->begin(), figures->end());
  const std::size_t middle = ratio.size() / 2;
  std::printf("%-24s %9zu %6zu %9.1e %5d %10zu %9.1e %9.1f %9.1f %7.2f %7.2f %7.2f\n", subject.name.c_str(),
              checked.count, checked.wrong.size(), checked.worst, fine.level, fine.count, fine.error, ours[middle],
              theirs[middle], ratio[middle], ratio.front(), ratio.back());
  constexpr std::size_t most_shown = 10;
  for (std::size_t i = 0; i < std::min(most_shown, checked.wrong.size()); ++i) {
    const auto& [point, by] = checked.wrong[i];
    std::printf("    wrong by %.1e: %.17g,%.17g,%.17g\n", by, point.x(), point.y(), point.z());
  }
  std::fflush(stdout);
  return checked.wrong.empty();
}

}  // namespace

int bench_closest(const ClosestBenchOptions& options) {
  std::printf("%-24s %9s %6s %9s %5s %10s %9s %9s %9s %7s %7s %7s\n", "model", "checked", "wrong", "worst", "level",
              "triangles", "error", "ours k/s", "CGAL k/s", "ratio", "least", "most");
  bool passed = true;
  for (const std::filesystem::path& file : options.models) passed &= bench_model(file, options);
  return passed ? exit_done : exit_check_failed;
}

}  // namespace shaolin
