#include "tools/cli/peers.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "schemes/builtin.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/load_plugin.h"
#include "schemes/obj.h"
#include "tools/validate/peer.h"

namespace shaolin {
namespace {

/// What a library did with the models of one class.
struct Cell {
  std::optional<double> worst;
  std::string worst_model;
  int declined = 0;

  std::string text() const {
    if (!worst) return declined > 0 ? "declines" : "not offered";
    char figure[32];
    std::snprintf(figure, sizeof figure, "%.1e%s", *worst, declined > 0 ? " *" : "");
    return figure;
  }
};

struct PeerRow {
  int models = 0;
  std::vector<Cell> cells;
};

/// Beyond, points are not where the scheme puts them: a hundred times what rounding does in a few steps.
constexpr double wrong = 1e-12;

void add(PeerRow& row, const PeerCase& of, const std::string& model,
         const std::vector<std::unique_ptr<const Peer>>& libraries) {
  ++row.models;
  row.cells.resize(libraries.size());
  for (std::size_t i = 0; i < libraries.size(); ++i) {
    if (!libraries[i]->offers(of)) continue;
    Cell& cell = row.cells[i];
    try {
      const double error = libraries[i]->error(of);
      if (!cell.worst || !(error <= *cell.worst)) cell.worst = error, cell.worst_model = model;
    } catch (const std::runtime_error&) {
      ++cell.declined;
    }
  }
}

}  // namespace

int peers(const PeersOptions& options) {
  const auto libraries = peers();
  std::vector<LoadedPlugin> plugins;
  for (const auto& file : options.plugins) plugins.push_back(load_plugin(file));
  std::map<std::pair<std::string, std::string>, PeerRow> rows;
  for (const auto& file : options.models) {
    const ControlMesh mesh = read_obj(file);
    if (!mesh.cones.empty()) throw InputError("no other library has conical vertices", file.string());
    const std::string model = file.stem().string(), shape = shape_class(mesh), scheme = default_scheme(mesh);
    add(rows[{scheme, shape}], {mesh, scheme, builtin_masks(scheme)}, model, libraries);
    for (const LoadedPlugin& plugin : plugins)
      if (plugin.masks->face_kind() == FaceKind::quad || mesh.all_triangles())
        add(rows[{plugin.name, shape}], {mesh, plugin.name, plugin.masks}, model, libraries);
  }

  std::printf("%-10s %-40s %6s", "scheme", "shape class", "models");
  for (const auto& library : libraries) std::printf("  %-14s", library->name().c_str());
  std::printf("\n%-10s %-40s %6s", "", "", "");
  for (const auto& library : libraries) std::printf("  %-14s", library->version().c_str());
  std::printf("\n");
  for (const auto& [key, row] : rows) {
    std::printf("%-10s %-40s %6d", key.first.c_str(), key.second.c_str(), row.models);
    for (const Cell& cell : row.cells) std::printf("  %-14s", cell.text().c_str());
    std::printf("\n");
  }
  std::printf("\nlargest error in diagonals of the control mesh; * declines some models of the class\n");
  for (const auto& [key, row] : rows)
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      if (row.cells[i].worst && !(*row.cells[i].worst <= wrong))
        std::printf("%s is off by %.2e at %s, %s\n", libraries[i]->name().c_str(), *row.cells[i].worst,
                    row.cells[i].worst_model.c_str(), key.first.c_str());
  return exit_done;
}

void add_peers(CLI::App& app, Command& command) {
  const auto options = std::make_shared<PeersOptions>();
  CLI::App* sub = app.add_subcommand(
      "peers", "Hold OpenSubdiv, CGAL and OpenMesh to the shapes that they claim to subdivide, each with its scheme");
  sub->add_option("MODEL", options->models, "Control meshes: OBJ files with OpenSubdiv's tag lines")->required();
  sub->add_option("--plugin", options->plugins,
                  "Shared libraries with schemes (see docs/schemes.md), whose code is run")
      ->type_name("FILE");
  sub->callback([options, &command] { command = [options] { return peers(*options); }; });
}

}  // namespace shaolin
