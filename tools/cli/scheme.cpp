#include "tools/cli/scheme.h"

#include <cstdio>
#include <fstream>
#include <memory>

#include "schemes/builtin.h"
#include "tools/cli/mask_tables.h"
#include "tools/cli/model.h"
#include "tools/cli/output_file.h"
#include "tools/conformance/report.h"

namespace shaolin {
namespace {

/// Either kind of scheme, as plug-ins are handed over. The built-in ones all give crease rules.
LoadedPlugin load(const SchemeChoice& choice) {
  if (!choice.plugin.empty()) return load_plugin(choice.plugin);
  return {choice.name, builtin_masks(choice.name), true};
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

/// NAME or --plugin, one of them.
void add_scheme_choice(CLI::App& app, SchemeChoice& choice) {
  CLI::Option_group* const group = app.add_option_group("scheme", "One of them");
  group->add_option("NAME", choice.name, "The scheme: " + builtin_scheme_names())->check(is_scheme_name());
  add_plugin_option(*group, choice.plugin);
  group->require_option(1);
}

}  // namespace

int scheme_list() {
  for (const BuiltinScheme& scheme : builtin_schemes())
    std::printf("%-9s %-10s %s\n", scheme.name, faces_of(scheme.face_kind), scheme.about);
  return exit_done;
}

int scheme_show(const SchemeChoice& choice) {
  const LoadedPlugin scheme = load(choice);
  print_masks(scheme);
  show_spectra(check_conformance(scheme.name, scheme.masks));
  return exit_done;
}

int scheme_check(const SchemeCheckOptions& options) {
  const LoadedPlugin scheme = load(options.choice);
  const std::filesystem::path page = options.report / (scheme.name + ".html");
  std::unique_ptr<OutputFile> file;
  if (!options.report.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.report, error);
    if (error) throw InputError("cannot make the folder: " + error.message(), options.report.string());
    file = std::make_unique<OutputFile>(page);
  }
  if (!scheme.has_crease)
    std::printf("%s has no crease rules: the cubic B-spline curve's are used\n\n", scheme.name.c_str());
  const ConformanceReport report = check_conformance(scheme.name, scheme.masks, options.most_faces);
  print_table(report);
  if (file) {
    std::ofstream stream(file->path());
    write_html(stream, report);
    stream.close();
    if (!stream) throw InputError("cannot write the report", page.string());
    file->commit();
    std::printf("\nwrote %s\n", page.c_str());
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
  add_scheme_choice(*show, options->choice);
  show->callback([options, &command] { command = [options] { return scheme_show(options->choice); }; });

  CLI::App* check = sub->add_subcommand(
      "check", "Run the conformance kit: sums, invariance, spectra, limit masks, bounds; exits with 1 on a failure");
  add_scheme_choice(*check, options->choice);
  check->add_option("--report", options->report, "Folder for a page with spectra and characteristic maps")
      ->type_name("DIR");
  check->add_option("--valence", options->most_faces, "The highest valence to look at; time grows as its fourth power")
      ->check(CLI::Range(3, 100))
      ->capture_default_str();
  check->callback([options, &command] { command = [options] { return scheme_check(*options); }; });
}

}  // namespace shaolin
