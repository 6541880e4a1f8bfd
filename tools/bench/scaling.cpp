#include "tools/bench/scaling.h"

#include <malloc.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "intersect/scene.h"
#include "schemes/errors.h"
#include "schemes/obj.h"
#include "tools/bench/report_folder.h"
#include "tools/cli/command.h"
#include "tools/cli/csv.h"
#include "tools/cli/output_file.h"
#include "tools/cli/threads.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin {
namespace {

constexpr std::size_t most_faces_of_oracle = 100000;  ///< OpenSubdiv's tables of a million take gigabytes
constexpr const char* scheme = "catmark";

/// About so many quads around a ring whose tube swells and shrinks.
ControlMesh bumpy_torus(std::size_t faces) {
  const int along = std::max(3, static_cast<int>(std::sqrt(static_cast<double>(faces) / 2)));
  const int around = std::max(3, static_cast<int>(faces) / along);
  ControlMesh mesh;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along;
      const double tube = 0.7 + 0.08 * std::sin(5 * a) * std::cos(3 * b);
      const double radius = 2 + tube * std::cos(b);
      mesh.positions.emplace_back(radius * std::cos(a), tube * std::sin(b), radius * std::sin(a));
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int next = (i + 1) % around, row = j * around, next_row = (j + 1) % along * around;
      mesh.add_face(std::vector<int>{row + i, next_row + i, next_row + next, row + next});
    }
  return mesh;
}

double seconds(const auto& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Ray> camera_rays(const Box& bounds, ImageSize size) {
  const View view(default_camera(bounds, size), size);
  std::vector<Ray> rays;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) rays.push_back(view.ray(x, y));
  return rays;
}

using Hits = std::vector<std::optional<Hit>>;

Hits hits_of(const Scene& scene, const std::vector<Ray>& rays, int threads) {
  Hits hits;
  run_with_threads(threads, [&] { hits = scene.intersect(rays); });
  return hits;
}

bool are_same(const Hits& a, const Hits& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].has_value() != b[i].has_value()) return false;
    if (a[i] && (a[i]->t != b[i]->t || a[i]->at.face != b[i]->at.face || a[i]->instance != b[i]->instance ||
                 a[i]->sample.position != b[i]->sample.position))
      return false;
  }
  return true;
}

/// The largest distance of a sample of hits from OpenSubdiv's surface, in diagonals.
double distance_from_oracle(const ControlMesh& mesh, const Hits& hits) {
  const OpenSubdivOracle oracle(mesh, scheme);
  double worst = 0;
  const std::size_t stride = 1 + hits.size() / 1000;
  for (std::size_t i = 0; i < hits.size(); i += stride)
    if (hits[i]) worst = std::max(worst, (oracle.evaluate(hits[i]->at)->position - hits[i]->sample.position).norm());
  return worst / oracle.diagonal();
}

/// What malloc has given out, in its heap and in mappings of their own.
double heap_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

using MakeScene = std::function<Scene()>;

/// Everything but reading; sets `fault` in place of timing if two threads answer otherwise than one.
void measure(const MakeScene& make, const ScalingOptions& options, const ControlMesh* checked, ScalingResult& result) {
  std::vector<Ray> rays;
  {
    const Scene scene = make();
    rays = camera_rays(scene.bounds(), options.size);
    result.rays = rays.size();
    const std::uint64_t before = scene.statistics().bytes;
    const Hits hits = hits_of(scene, rays, 1);
    const Statistics after = scene.statistics();
    result.hits = after.hits;
    result.faces_touched = after.faces_touched;
    result.bytes_refined = after.bytes - before;
    if (!are_same(hits, hits_of(make(), rays, 2))) result.fault = "two threads answer otherwise than one";
    if (result.hits == 0) result.fault = "no ray hits";
    if (checked && result.fault.empty())
      if (const double distance = distance_from_oracle(*checked, hits); !(distance <= 1e-9))
        result.fault = "a hit is off OpenSubdiv's surface by " + std::to_string(distance) + " diagonals";
  }
  if (!result.fault.empty()) return;
  for (int run = 0; run < options.runs; ++run)
    for (const int threads : {1, 2}) {
      malloc_trim(0);
      const double heap = heap_bytes();
      std::optional<Scene> scene;
      const double build = seconds([&] { scene.emplace(make()); });
      if (threads == 1) {
        result.build.push_back(build);
        result.bytes.push_back(heap_bytes() - heap);
      }
      const auto trace = [&] { hits_of(*scene, rays, threads); };
      result.cold[static_cast<std::size_t>(threads - 1)].push_back(seconds(trace));
      result.warm[static_cast<std::size_t>(threads - 1)].push_back(seconds(trace));
    }
}

ScalingResult measure_mesh(std::size_t faces, const ScalingOptions& options) {
  const std::filesystem::path file = options.report / ("torus-" + std::to_string(faces) + ".obj");
  {
    OutputFile output(file);
    std::ofstream stream(output.path());
    write_obj(stream, bumpy_torus(faces));
    stream.close();
    output.commit();
  }
  ControlMesh mesh;
  ScalingResult result;
  for (int run = 0; run < options.runs; ++run) result.read.push_back(seconds([&] { mesh = read_obj(file); }));
  std::filesystem::remove(file);
  result.scene = "one mesh";
  result.faces = static_cast<std::size_t>(mesh.face_count());
  const bool checked = result.faces <= most_faces_of_oracle;
  measure([&] { return Scene(mesh, scheme); }, options, checked ? &mesh : nullptr, result);
  return result;
}

/// A square of tori, of 10^4 faces each or fewer.
ScalingResult measure_instances(const ScalingOptions& options) {
  const ControlMesh mesh = bumpy_torus(std::min<std::size_t>(10000, options.instanced));
  const auto faces = static_cast<std::size_t>(mesh.face_count());
  const std::size_t copies = std::max<std::size_t>(1, options.instanced / faces);
  const auto side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(copies))));
  ScalingResult result;
  result.scene = "instances";
  result.instances = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  result.faces = faces * result.instances;
  measure(
      [&] {
        const auto object = make_object(mesh, scheme);
        std::vector<Instance> instances;
        for (int i = 0; i < side; ++i)
          for (int j = 0; j < side; ++j) {
            Affine place = Affine::Identity();
            place.translation() = 6 * Vec3(i, 0, j);
            instances.push_back({object, place});
          }
        return Scene(std::move(instances));
      },
      options, nullptr, result);
  return result;
}

void print(const ScalingResult& result) {
  if (!result.fault.empty()) {
    std::printf("%-10s %10zu faces: not timed, %s\n", result.scene.c_str(), result.faces, result.fault.c_str());
    return;
  }
  const double build = spread(result.build).median, each = 1e6 / static_cast<double>(result.faces);
  std::printf("%-10s %10zu faces: build %.3f s (%.2f us and %.0f bytes a face)", result.scene.c_str(), result.faces,
              build, build * each, spread(result.bytes).median * each / 1e6);
  if (!result.read.empty()) std::printf(", %.2f of reading", build / spread(result.read).median);
  std::printf("; first image %.3f s, two threads %.3f\n", spread(result.cold[0]).median, spread(result.cold[1]).median);
  std::fflush(stdout);
}

void write_table(const std::filesystem::path& file, const std::vector<ScalingResult>& results) {
  CsvWriter writer(file,
                   "scene,faces,instances,read,build,bytes,cold_1,cold_2,warm_1,warm_2,rays,hits,faces_touched,"
                   "bytes_refined");
  for (const ScalingResult& result : results) {
    writer.field(result.scene)
        .field(static_cast<long long>(result.faces))
        .field(static_cast<long long>(result.instances));
    for (const auto* values : {&result.read, &result.build, &result.bytes, &result.cold[0], &result.cold[1],
                               &result.warm[0], &result.warm[1]})
      if (values->empty())
        writer.empty();
      else
        writer.field(spread(*values).median);
    writer.field(static_cast<long long>(result.rays))
        .field(static_cast<long long>(result.hits))
        .field(static_cast<long long>(result.faces_touched))
        .field(static_cast<long long>(result.bytes_refined))
        .end_row();
  }
  writer.commit();
}

}  // namespace

int bench_scaling(const ScalingOptions& options) {
  make_report_folder(options.report);
  std::vector<ScalingResult> results;
  for (const std::size_t faces : options.faces) {
    results.push_back(measure_mesh(faces, options));
    print(results.back());
  }
  if (options.instanced > 0) {
    results.push_back(measure_instances(options));
    print(results.back());
  }
  write_table(options.report / "scaling.csv", results);
  write_page(options.report / "scaling.html", [&](std::ostream& out) { write_scaling_page(out, results, options); });
  const bool all_timed =
      std::all_of(results.begin(), results.end(), [](const ScalingResult& one) { return one.fault.empty(); });
  return all_timed ? exit_done : exit_check_failed;
}

}  // namespace shaolin
