#include "tools/bench/moved.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "schemes/errors.h"
#include "tools/bench/error_figures.h"
#include "tools/bench/exact_errors.h"
#include "tools/bench/triangle_tree.h"
#include "tools/cli/command.h"
#include "tools/cli/threads.h"
#include "tools/validate/sampling.h"

namespace shaolin {
namespace {

/// From around the model, and aimed at edges and vertices, without an end.
std::vector<Ray> rays_at(const Scene& scene, std::size_t count, std::uint64_t seed) {
  std::vector<Ray> rays;
  for (std::size_t wanted = count; rays.size() < count; wanted *= 2) {
    rays.clear();
    for (const ProbeRay& probe : sample_rays(SampledSurface::of(scene.surface()), wanted, seed))
      if (probe.kind == RayKind::camera || probe.kind == RayKind::aimed)
        rays.push_back({probe.ray.origin, probe.ray.direction});
  }
  rays.resize(count);
  return rays;
}

/// A model that was moved, and what the exact method says of its rays.
class MovedModel {
 public:
  MovedModel(std::string move, Stage stage, const MovedOptions& options)
      : move_(std::move(move)), stage_(std::move(stage)), exact_(scene_of(stage_)), options_(options) {
    rays_ = rays_at(exact_, options.rays, options.seed);
    expected_ = trace(rays_, exact_);
    diagonal_ = (exact_.bounds().upper - exact_.bounds().lower).norm();
  }

  void print_exact() const {
    const auto hits = static_cast<std::size_t>(
        std::count_if(expected_.begin(), expected_.end(), [](const auto& answer) { return answer.has_value(); }));
    const ExactErrors errors = exact_errors(stage_, exact_, rays_, options_.exact_hits);
    print("ShaoLin exact", hits, "-", "-", errors.position);
  }

  void print_contender(const Contender& contender) const {
    const std::unique_ptr<Tracer> tracer = make_tracer(contender, stage_);
    Answers answers = trace(rays_, *tracer);
    // In single precision a tiny model may be met at no number: that is no hit.
    for (auto& answer : answers)
      if (answer && !std::isfinite(answer->t)) answer.reset();
    print(contender.name(), contender, answers);
  }

  void print_cgal() const {
    const LoadedModel& model = stage_.models.front();
    const TriangleTree tree(uniform_triangles(model.mesh, model.scheme, options_.level));
    print("CGAL, level " + std::to_string(options_.level), {}, trace(rays_, [&](const Ray& ray) {
            const std::optional<double> t = tree.first(ray);
            return t ? std::optional(Answer{*t}) : std::nullopt;
          }));
  }

 private:
  static Scene scene_of(Stage stage) { return build_scene(stage); }

  void print(const std::string& method, const Contender& contender, const Answers& answers) const {
    const ErrorFigures figures = compare(contender, exact_, rays_, expected_, answers);
    print(method, figures.own_hits(), std::to_string(figures.lost), std::to_string(figures.ghosts), figures.distance);
  }

  void print(const std::string& method, std::size_t hits, const std::string& lost, const std::string& ghosts,
             const Quantiles& errors) const {
    std::printf("%-20s %-14s %-28s %8zu %8zu %8s %8s %9.1e %9.1e %9.1e\n",
                std::filesystem::path(stage_.file).stem().c_str(), move_.c_str(), method.c_str(), rays_.size(), hits,
                lost.c_str(), ghosts.c_str(), errors.median / diagonal_, errors.p99 / diagonal_,
                errors.max / diagonal_);
    std::fflush(stdout);
  }

  std::string move_;
  Stage stage_;
  Scene exact_;
  const MovedOptions& options_;
  std::vector<Ray> rays_;
  Answers expected_;
  double diagonal_ = 0;
};

void bench_move(const std::string& kind, double by, Stage stage, const MovedOptions& options) {
  ControlMesh& mesh = stage.models.front().mesh;
  const Vec3 shift = kind == "shift" ? Vec3(by * mesh.diagonal() * Vec3(0.7, -1, 0.4)) : Vec3(Vec3::Zero());
  const double scale = kind == "scale" ? by : 1;
  for (Vec3& point : mesh.positions) point = scale * point + shift;
  char move[32];
  std::snprintf(move, sizeof move, "%s %g", kind.c_str(), by);
  const std::string scheme = stage.models.front().scheme;
  const MovedModel model(move, std::move(stage), options);
  model.print_exact();
  if (scheme != "loop" && scheme != "catmark") return;
  for (const ContenderKind peer : {ContenderKind::triangles, ContenderKind::subdivision}) {
    if (peer == ContenderKind::subdivision && scheme != "catmark") continue;
    model.print_contender({.kind = peer, .level = options.level, .is_robust = true});
  }
  model.print_cgal();
}

}  // namespace

int bench_moved(const MovedOptions& options) {
  std::printf("%-20s %-14s %-28s %8s %8s %8s %8s %9s %9s %9s\n", "model", "move", "method", "rays", "hits", "lost",
              "ghosts", "median", "p99", "max");
  run_with_threads(options.threads, [&] {
    for (const std::filesystem::path& file : options.models) {
      const Stage stage = load_stage({file, options.scheme.scheme, options.scheme.plugin});
      if (stage.is_scene) throw InputError(file.string() + ": is a scene; a model is needed");
      for (const double shift : options.shifts) bench_move("shift", shift, stage, options);
      for (const double scale : options.scales) bench_move("scale", scale, stage, options);
    }
  });
  return exit_done;
}

}  // namespace shaolin
