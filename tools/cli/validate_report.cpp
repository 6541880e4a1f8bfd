#include "tools/cli/validate_report.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "tools/cli/json_text.h"

namespace shaolin {
namespace {

constexpr std::size_t most_printed = 10;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json("infinite"); }

Json to_json(const SurfaceParameter& at) { return {{"face", at.face}, {"sub", at.sub}, {"u", at.u}, {"v", at.v}}; }

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json to_json(const Ray& ray) {
  return {{"origin", to_json(ray.origin)},
          {"direction", to_json(ray.direction)},
          {"tmin", number(ray.tmin)},
          {"tmax", number(ray.tmax)}};
}

Json to_json(const SampledErrors& errors) {
  const ErrorSummary& s = errors.summary;
  Json json{{"count", s.count}, {"median", number(s.median)}, {"p99", number(s.p99)}, {"max", number(s.max)}};
  if (s.count > 0) json["worst"] = to_json(errors.worst);
  return json;
}

Json to_json(const EvaluationReport& report) {
  return {{"count", report.evaluations},
          {"faces", report.faces},
          {"faces_without_limit", report.faces_without_limit},
          {"passed", report.passed()},
          {"position", to_json(report.positions)},
          {"normal", to_json(report.normals)},
          {"undetermined_normal", to_json(report.undetermined_normals)},
          {"derivative", to_json(report.derivatives)}};
}

Json to_json(const RayFigures& figures) {
  return {{"rays", figures.rays},
          {"hits", figures.hits},
          {"lost", figures.lost},
          {"ghosts", figures.ghosts},
          {"wrong_normals", figures.wrong_normals},
          {"wrong_occluded", figures.wrong_occluded},
          {"undecided", figures.undecided},
          {"seen", figures.seen},
          {"undetermined_normals", figures.undetermined_normals},
          {"uncertified", figures.uncertified},
          {"worst_on_ray", number(figures.worst_on_ray)},
          {"worst_on_surface", number(figures.worst_on_surface)},
          {"worst_normal", number(figures.worst_normal)}};
}

Json to_json(const RayReport& report) {
  Json json = Json::object();
  for (std::size_t i = 0; i < ray_kinds.size(); ++i) json[name_of(ray_kinds[i])] = to_json(report.by_kind[i]);
  json["all"] = to_json(report.total());
  return json;
}

Json to_json(const ExactHitFigures& figures) {
  return {{"rays", figures.rays},
          {"hits", figures.hits},
          {"certified", figures.certified},
          {"worst_position", number(figures.worst_position)},
          {"worst_ulps", number(figures.worst_ulps)},
          {"worst_bound_share", number(figures.worst_bound_share)},
          {"worst_residual", number(figures.worst_residual)}};
}

Json to_json(const ExactTriangleFigures& figures) {
  return {{"level", Validation::exact_level}, {"rays", figures.rays},       {"hits", figures.hits},
          {"decisions", figures.decisions},   {"excused", figures.excused}, {"worst_t", number(figures.worst_t)}};
}

std::string replay_row(const Disagreement& d) { return d.ray ? exact(*d.ray) : d.at ? exact(*d.at) : std::string(); }

Json to_json(const Disagreement& d) {
  Json json{{"what", d.what}, {"error", number(d.error)}, {"allowed", d.allowed}};
  if (d.at) json["at"] = to_json(*d.at);
  if (d.ray) json["ray"] = to_json(*d.ray);
  json["replay"] = replay_row(d);
  json["detail"] = d.detail;
  return json;
}

Json bars() {
  return {{"position_median", bar::position_median},
          {"position_p99", bar::position_p99},
          {"position_max", bar::position_max},
          {"normal", bar::normal},
          {"derivative", bar::derivative},
          {"on_ray", bar::on_ray},
          {"on_surface", bar::on_surface},
          {"lost", 0},
          {"ghosts", 0}};
}

Json to_json(const Validation& validation) {
  Json disagreements = Json::array();
  const auto append = [&](const std::vector<Disagreement>& list) {
    for (const Disagreement& d : list) disagreements.push_back(to_json(d));
  };
  append(validation.evaluations.disagreements);
  append(validation.rays.disagreements);
  if (validation.exact_hits) append(validation.exact_hits->disagreements);
  if (validation.exact_triangles) append(validation.exact_triangles->disagreements);
  Json json{{"model", validation.model},
            {"scheme", validation.scheme},
            {"oracle", validation.oracle},
            {"seed", validation.seed},
            {"diagonal", validation.diagonal},
            {"dense_level", validation.dense_level},
            {"seconds", validation.seconds},
            {"passed", validation.passed()},
            {"evaluations", to_json(validation.evaluations)},
            {"rays", to_json(validation.rays)},
            {"bars", bars()},
            {"disagreements", std::move(disagreements)}};
  if (validation.exact_hits) json["exact_hits"] = to_json(*validation.exact_hits);
  if (validation.exact_triangles) json["exact_triangles"] = to_json(*validation.exact_triangles);
  if (!validation.no_triangles.empty()) json["no_triangles"] = validation.no_triangles;
  return json;
}

void print_figure(const char* name, double value, double allowed) {
  std::printf("  %-44s %9.2e   %9.0e   %s\n", name, value, allowed, value <= allowed ? "pass" : "FAIL");
}

void print_count(const char* name, std::size_t value, const char* note = "") {
  std::printf("  %-44s %9zu%s%s\n", name, value, *note ? "   " : "", note);
}

void print_fault_count(const char* name, std::size_t value) {
  std::printf("  %-44s %9zu   %9d   %s\n", name, value, 0, value == 0 ? "pass" : "FAIL");
}

void print_evaluations(const EvaluationReport& report) {
  std::printf("\nEvaluations: %zu, %d faces, %d without a limit surface\n", report.evaluations, report.faces,
              report.faces_without_limit);
  std::printf("  %-44s %9s   %9s\n", "", "figure", "bar");
  const ErrorSummary& position = report.positions.summary;
  print_figure("position error, median / diagonal", position.median, bar::position_median);
  print_figure("position error, 99th percentile", position.p99, bar::position_p99);
  print_figure("position error, maximum", position.max, bar::position_max);
  if (position.count > 0) std::printf("    at face,sub,u,v %s\n", exact(report.positions.worst).c_str());
  const ErrorSummary& normal = report.normals.summary;
  std::printf("  %-44s %9.2e\n", "normal error, median (rad)", normal.median);
  std::printf("  %-44s %9.2e\n", "normal error, 99th percentile", normal.p99);
  print_figure("normal error, maximum", normal.max, bar::normal);
  if (normal.count > 0) std::printf("    at face,sub,u,v %s\n", exact(report.normals.worst).c_str());
  const ErrorSummary& undetermined = report.undetermined_normals.summary;
  print_count("normals that doubles do not determine", undetermined.count, "not judged");
  if (undetermined.count > 0) {
    std::printf("    apart by at most %.2e rad, at face,sub,u,v %s\n", undetermined.max,
                exact(report.undetermined_normals.worst).c_str());
  }
  print_figure("derivative error, maximum (relative)", report.derivatives.summary.max, bar::derivative);
}

void print_ray_line(const char* name, const RayFigures& f) {
  std::printf("  %-12s %7zu %7zu %5zu %6zu %8zu %8zu %9zu %8zu   %8.1e   %8.1e %8.1e\n", name, f.rays, f.hits, f.lost,
              f.ghosts, f.wrong_normals, f.wrong_occluded, f.undecided, f.seen, f.worst_on_ray, f.worst_on_surface,
              f.worst_normal);
}

void print_rays(const Validation& validation) {
  const RayFigures all = validation.rays.total();
  if (all.rays == 0) return;
  if (validation.dense_level > 0)
    std::printf("\nRays: %zu, against a grid of %d steps a side\n", all.rays, 1 << validation.dense_level);
  else
    std::printf("\nRays: %zu; hits are missed only where rays were aimed at the surface\n", all.rays);
  std::printf("  %-12s %7s %7s %5s %6s %8s %8s %9s %8s   %8s   %8s %8s\n", "", "rays", "hits", "lost", "ghosts",
              "normals", "occluded", "undecided", "seen", "on ray", "on surf.", "normal");
  for (std::size_t i = 0; i < ray_kinds.size(); ++i) {
    print_ray_line(name_of(ray_kinds[i]), validation.rays.by_kind[i]);
  }
  print_ray_line("all", all);
  print_fault_count("lost hits", all.lost);
  print_fault_count("ghost hits", all.ghosts);
  print_fault_count("any-hit answers unlike the closest hit's", all.wrong_occluded);
  print_figure("off the ray / (|t| |d| + diagonal)", all.worst_on_ray, bar::on_ray);
  print_figure("off the surface / diagonal", all.worst_on_surface, bar::on_surface);
  print_figure("normal at a hit (rad)", all.worst_normal, bar::normal);
  print_count("normals that doubles do not determine", all.undetermined_normals, "not judged");
  print_count("misses within 1e-10 diagonals of an outline", all.undecided, "not judged");
  print_count("hits not certified", all.uncertified);
}

void print_exact(const Validation& validation) {
  if (validation.exact_hits) {
    const ExactHitFigures& hits = *validation.exact_hits;
    std::printf("\nHits in exact arithmetic: %zu of %zu rays\n", hits.hits, hits.rays);
    print_count("certified", hits.certified);
    print_figure("distance from the crossing / certificate's error", hits.worst_bound_share, 1);
    std::printf("  %-44s %9.2e   of the diagonal; %.1f ulps of the coordinates\n", "distance from the crossing",
                hits.worst_position, hits.worst_ulps);
    std::printf("  %-44s %9.2e   of the diagonal\n", "residual of hits not certified", hits.worst_residual);
    print_fault_count("disagreements", hits.disagreements.size());
  }
  if (!validation.no_triangles.empty())
    std::printf("\nTriangles in exact arithmetic: none (%s)\n", validation.no_triangles.c_str());
  if (validation.exact_triangles) {
    const ExactTriangleFigures& triangles = *validation.exact_triangles;
    std::printf("\nTriangles in exact arithmetic: %zu rays, %zu decisions\n", triangles.rays, triangles.decisions);
    print_count("hits", triangles.hits);
    print_count("within rounding of an outline or boundary", triangles.excused, "not judged");
    std::printf("  %-44s %9.2e   of |t| |d| + diagonal\n", "distance along the ray", triangles.worst_t);
    print_fault_count("disagreements", triangles.disagreements.size());
  }
}

void print_disagreements(const std::string& rows, const std::vector<Disagreement>& disagreements) {
  if (disagreements.empty()) return;
  std::printf("\n%zu disagreements; each row replays with 'shaolin %s'\n", disagreements.size(), rows.c_str());
  for (std::size_t i = 0; i < std::min(most_printed, disagreements.size()); ++i) {
    const Disagreement& d = disagreements[i];
    std::printf("  %s: %.3e, allowed %.0e\n    %s\n    %s\n", d.what.c_str(), d.error, d.allowed, replay_row(d).c_str(),
                d.detail.c_str());
  }
  if (disagreements.size() > most_printed) {
    std::printf("  and %zu more; --report lists all\n", disagreements.size() - most_printed);
  }
}

}  // namespace

void print_validation(const Validation& validation) {
  std::printf("model     %s\nscheme    %s\noracle    %s\nseed      %llu\n", validation.model.c_str(),
              validation.scheme.c_str(), validation.oracle.c_str(), static_cast<unsigned long long>(validation.seed));
  print_evaluations(validation.evaluations);
  print_rays(validation);
  print_exact(validation);
  const std::string query = "query " + validation.model + " --scheme " + validation.scheme, row = " --ray=ROW";
  print_disagreements("eval --params", validation.evaluations.disagreements);
  print_disagreements(query + row, validation.rays.disagreements);
  if (validation.exact_hits) print_disagreements(query + row, validation.exact_hits->disagreements);
  if (validation.exact_triangles)
    print_disagreements(query + " --uniform " + std::to_string(Validation::exact_level) + row,
                        validation.exact_triangles->disagreements);
  std::printf("\n%s (%.1f s)\n", validation.passed() ? "PASS" : "FAIL", validation.seconds);
}

void write_validation(const std::filesystem::path& file, const Validation& validation) {
  std::ofstream stream(file);
  stream << to_json(validation).dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot write the report");
}

}  // namespace shaolin
