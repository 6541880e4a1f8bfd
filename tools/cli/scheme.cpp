#include "tools/cli/scheme.h"

#include <cstdio>
#include <fstream>
#include <memory>

#include "schemes/builtin.h"
#include "tools/cli/model.h"
#include "tools/cli/output_file.h"
#include "tools/conformance/report.h"

namespace shaolin {
namespace {

const char* faces_of(FaceKind kind) { return kind == FaceKind::triangle ? "triangles" : "quads"; }

void show_vertex_masks(const SchemeMasks& masks) {
  const bool quads = masks.face_kind() == FaceKind::quad;
  std::printf("\nvertex masks: the vertex, each of n neighbours%s\n", quads ? ", each of n new face points" : "");
  std::printf("limit masks:  the vertex, each of n neighbours%s\n\n", quads ? ", each of n diagonals" : "");
  std::printf("  %3s  %-34s  %-34s\n", "n", "refinement", "limit");
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 20}) {
    const VertexMask vertex = masks.smooth_vertex(n);
    const LimitMask limit = masks.smooth_limit(n);
    std::printf("  %3d  %10.8f  %10.8f", n, vertex.vertex, vertex.edge);
    quads ? std::printf("  %10.8f  ", vertex.face) : std::printf("              ");
    std::printf("%10.8f  %10.8f", limit.vertex, limit.edge);
    quads ? std::printf("  %10.8f\n", limit.diagonal) : std::printf("\n");
  }
}

void show_spectra(const ConformanceReport& report) {
  std::printf("\neigenvalues by modulus\n\n");
  for (const SpectrumRow& row : report.spectra) {
    const bool few = row.kind == StarKind::smooth || row.kind == StarKind::dart ? row.faces <= 8 : row.faces <= 4;
    if (!few) continue;
    std::printf("  %-7s %2d ", to_string(row.kind).c_str(), row.faces);
    for (const double modulus : row.moduli) std::printf("  %.6f", modulus);
    std::printf("\n");
  }
}

void print_table(const ConformanceReport& report) {
  std::printf("%-28s %-24s %10s %10s\n", "check", "worst at", "figure", "bar");
  for (const CheckResult& check : report.checks) {
    std::printf("%-28s %-24s %10.2e %10.2e  %s\n", check.name.c_str(), check.subject.c_str(), check.figure, check.bar,
                to_string(check.verdict));
    if (!check.note.empty()) std::printf("    %s\n", check.note.c_str());
  }
}

}  // namespace

int scheme_list() {
  for (const BuiltinScheme& scheme : builtin_schemes())
    std::printf("%-9s %-10s %s\n", scheme.name, faces_of(scheme.face_kind), scheme.about);
  return exit_done;
}

int scheme_show(const std::string& name) {
  const auto masks = builtin_masks(name);
  const EdgeMask edge = masks->smooth_edge();
  const CreaseMask crease = masks->crease();
  std::printf("%s: on %s, %s\n\n", name.c_str(), faces_of(masks->face_kind()),
              masks->basis() == Basis::spline ? "splines where regular" : "linear patches");
  std::printf("edge mask:    each end %.8f, each %s %.8f\n", edge.end,
              masks->face_kind() == FaceKind::quad ? "new face point" : "opposite vertex", edge.side);
  std::printf("crease mask:  the vertex %.8f, each neighbour %.8f; limit %.8f, %.8f\n", crease.vertex, crease.edge,
              crease.limit_vertex, crease.limit_edge);
  show_vertex_masks(*masks);
  show_spectra(check_conformance(name, masks));
  return exit_done;
}

int scheme_check(const SchemeCheckOptions& options) {
  const auto masks = builtin_masks(options.name);
  std::unique_ptr<OutputFile> file;
  if (!options.report.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.report, error);
    if (error) throw InputError("cannot make the folder: " + error.message(), options.report.string());
    file = std::make_unique<OutputFile>(options.report / (options.name + ".html"));
  }
  const ConformanceReport report = check_conformance(options.name, masks);
  print_table(report);
  if (file) {
    std::ofstream stream(file->path());
    write_html(stream, report);
    stream.close();
    if (!stream) throw InputError("cannot write the report", (options.report / (options.name + ".html")).string());
    file->commit();
    std::printf("\nwrote %s\n", (options.report / (options.name + ".html")).c_str());
  }
  std::printf("\n%s\n", report.passed() ? "PASS" : "FAIL");
  return report.passed() ? exit_done : exit_check_failed;
}

void add_scheme(CLI::App& app, Command& command) {
  CLI::App* sub =
      app.add_subcommand("scheme", "List the schemes, show their masks, check that they keep their promises");
  sub->require_subcommand(1);
  sub->add_subcommand("list", "Print the built-in schemes")->callback([&command] { command = scheme_list; });

  const auto options = std::make_shared<SchemeCheckOptions>();
  CLI::App* show = sub->add_subcommand("show", "Print a scheme's masks, limit masks and eigenvalues by valence");
  show->add_option("NAME", options->name, "The scheme: " + builtin_scheme_names())->required()->check(is_scheme_name());
  show->callback([options, &command] { command = [options] { return scheme_show(options->name); }; });

  CLI::App* check = sub->add_subcommand(
      "check", "Run the conformance kit: sums, invariance, spectra, limit masks, bounds; exits with 1 on a failure");
  check->add_option("NAME", options->name, "The scheme: " + builtin_scheme_names())
      ->required()
      ->check(is_scheme_name());
  check->add_option("--report", options->report, "Folder for a page with spectra and characteristic maps")
      ->type_name("DIR");
  check->callback([options, &command] { command = [options] { return scheme_check(*options); }; });
}

}  // namespace shaolin
