#include "tools/cli/validate.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "intersect/scene.h"
#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "tools/cli/distinct_files.h"
#include "tools/cli/number_checks.h"
#include "tools/cli/output_file.h"
#include "tools/cli/render_stats.h"
#include "tools/cli/threads.h"
#include "tools/cli/validate_report.h"
#include "tools/validate/mask_oracle.h"
#include "tools/validate/opensubdiv_oracle.h"

namespace shaolin {
namespace {

/// So many evaluations for the dense check's grids at most, but at least 8 steps a side: about 10 s.
constexpr double most_grid_points = 1.5e6;
constexpr int least_level = 3, most_level = 6;

int dense_level_for(const Oracle& oracle) {
  double pieces = 0;
  for (int face = 0; face < oracle.face_count(); ++face) pieces += oracle.has_limit(face) ? oracle.sub_count(face) : 0;
  int level = most_level;
  while (level > least_level && pieces * (1 << level) * (1 << level) > most_grid_points) --level;
  return level;
}

/// So many take some seconds.
struct Samples {
  std::size_t evaluations, rays;
};
constexpr Samples by_opensubdiv_default{10000, 30000}, by_masks_default{300, 300};

/// OpenSubdiv has neither plug-ins nor conical vertices.
bool opensubdiv_has(const LoadedModel& model) {
  return !model.masks && model.mesh.cones.empty() && OpenSubdivOracle::knows(model.scheme);
}

/// OpenSubdiv, or for what it does not have the masks themselves.
std::unique_ptr<const Oracle> make_oracle(const LoadedModel& model) {
  if (opensubdiv_has(model)) return std::make_unique<OpenSubdivOracle>(model.mesh, model.scheme);
  return std::make_unique<MaskOracle>(model.mesh, model.masks ? model.masks : builtin_masks(model.scheme));
}

/// Of a built-in scheme, in exact arithmetic: hits, and decisions about chord triangles.
void check_exactly(Validation& result, const ControlMesh& mesh, const Scene& scene, const Oracle& oracle,
                   const ValidateOptions& options) {
  const auto rays = sample_rays(oracle, options.exact, options.seed);
  result.exact_hits = check_exact_hits(Intersector::of(scene), mesh, QuadOracle(mesh, result.scheme), rays);
  TriangleSoup soup;
  try {
    soup = uniform_triangles(mesh, result.scheme, Validation::exact_level);
    if (soup.triangles.empty()) result.no_triangles = "of loop and catmark only";
  } catch (const InputError& error) {
    // Refined as a whole, a mesh must fit half-edges; face by face, as rays meet it, it need not.
    result.no_triangles = error.what();
  }
  if (!result.no_triangles.empty()) return;
  SceneOptions triangles;
  triangles.method = Method::uniform;
  triangles.level = Validation::exact_level;
  const Scene uniform(mesh, result.scheme, triangles);
  result.exact_triangles = check_exact_triangles(Intersector::of(uniform), soup, rays);
}

Validation check_model(const ValidateOptions& options) {
  Stopwatch stopwatch;
  LoadedModel model = load_model(options.model);
  const bool by_opensubdiv = opensubdiv_has(model);
  const std::unique_ptr<const Oracle> oracle = make_oracle(model);
  Validation result{.model = options.model.file.string(),
                    .scheme = model.scheme,
                    .oracle = by_opensubdiv ? "OpenSubdiv" : "plain refinement by the masks (good to 1e-13 diagonals)",

                    .seed = options.seed};
  if (options.exact > 0 && model.masks)
    throw InputError(
        "--exact knows the masks of built-in schemes to all digits, a plug-in's not; expected no --plugin");
  const ControlMesh mesh = model.mesh;
  const Scene scene = build_scene(std::move(model));
  result.diagonal = oracle->diagonal();

  const Samples defaults = by_opensubdiv ? by_opensubdiv_default : by_masks_default;
  const auto parameters = sample_parameters(*oracle, options.evaluations.value_or(defaults.evaluations), options.seed);
  result.evaluations = check_evaluations(Evaluator::of(scene.surface()), *oracle, parameters);
  if (const std::size_t count = options.rays.value_or(defaults.rays); count > 0) {
    std::optional<DenseCheck> dense;
    if (by_opensubdiv) {
      result.dense_level = dense_level_for(*oracle);
      dense.emplace(*oracle, result.dense_level);
    }
    const auto rays = sample_rays(*oracle, count, options.seed);
    result.rays = check_rays(Intersector::of(scene), *oracle, dense ? &*dense : nullptr, rays);
  }
  if (options.exact > 0) check_exactly(result, mesh, scene, *oracle, options);
  result.seconds = stopwatch.lap();
  return result;
}

}  // namespace

int validate(const ValidateOptions& options) {
  // First, so that a report that cannot be written costs no minutes.
  std::optional<OutputFile> report;
  if (!options.report.empty()) report.emplace(options.report);
  Validation result;
  run_with_threads(options.threads, [&] { result = check_model(options); });
  print_validation(result);
  if (report) {
    write_validation(report->path(), result);
    report->commit();
  }
  return result.passed() ? exit_done : exit_check_failed;
}

void add_validate(CLI::App& app, Command& command) {
  const auto options = std::make_shared<ValidateOptions>();
  CLI::App* sub = app.add_subcommand(
      "validate",
      "Hold evaluations and rays against OpenSubdiv's surface, or, for schemes and conical vertices, which it does not "
      "have, against plain refinement by the masks; exits with 1 on any disagreement");
  add_model_options(*sub, options->model);
  sub->add_option("--rays", options->rays,
                  "Rays in thirds: from a camera, incoherent, grazing; a tenth of that in addition is aimed exactly at "
                  "edges and vertices of patches (default: 30000; 300 without OpenSubdiv, see docs/validation.md)")
      ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
  sub->add_option("--evaluations", options->evaluations,
                  "Evaluations; a quarter of them crowds towards corners of patches, down to 1e-8 (default: 10000; 300 "
                  "without OpenSubdiv)")
      ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
  sub->add_option(
         "--exact", options->exact,
         "So many rays besides, whose hits are derived again in numbers of 113 bits, held against their "
         "certificates, and whose decisions about chord triangles (--uniform 2) are made again by exact signs: "
         "0.1 s each (default: none)")
      ->check(CLI::Range(std::size_t{0}, std::size_t{100000000}));
  add_seed_option(*sub, options->seed);
  sub->add_option("--report", options->report, "JSON file for all figures and every disagreement")->type_name("FILE");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    expect_distinct_files({{"--report", options->report}}, inputs_of(options->model));
    command = [options] { return validate(*options); };
  });
}

}  // namespace shaolin
