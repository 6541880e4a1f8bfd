#include "tools/cli/info.h"

#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "intersect/validity.h"
#include "tools/cli/mesh_counts.h"
#include "tools/cli/scene_info.h"
#include "tools/cli/stage.h"

namespace shaolin {
namespace {

void print_heading(const char* heading) { std::printf("\n%s\n", heading); }

void print_count(const std::string& name, std::size_t count) { std::printf("  %-38s %10zu\n", name.c_str(), count); }

void print_point(const char* name, const Vec3& point) {
  std::printf("  %-8s %.9g %.9g %.9g\n", name, point.x(), point.y(), point.z());
}

std::string face_name(int size) {
  if (size == 3) return "triangles";
  if (size == 4) return "quads";
  return std::to_string(size) + "-gons";
}

const char* boundary_name(BoundaryInterpolation boundary) {
  switch (boundary) {
    case BoundaryInterpolation::none:
      return "none";
    case BoundaryInterpolation::edge_only:
      return "edge only";
    case BoundaryInterpolation::edge_and_corner:
      break;
  }
  return "edge and corner";
}

void print_general(const LimitSurface& surface, const std::string& scheme, const ModelOptions& options) {
  const ControlMesh& mesh = surface.control_mesh();
  const char* const origin = !options.scheme.empty()   ? "by --scheme"
                             : !options.plugin.empty() ? "by --plugin"
                             : !mesh.scheme.empty()    ? "by the file's tag"
                             : mesh.all_triangles()    ? "all faces are triangles"
                                                       : "not all faces are triangles";
  std::printf("model     %s\n", options.file.c_str());
  std::printf("scheme    %s (%s)\n", scheme.c_str(), origin);
  std::printf("boundary  %s\n", boundary_name(mesh.boundary));
  std::printf("creases   %s\n", mesh.crease_method == CreaseMethod::chaikin ? "chaikin" : "uniform");
}

void print_faces(const MeshCounts& counts, const LimitSurface& surface) {
  print_heading("Faces");
  print_count("all", counts.faces);
  for (const auto& [size, number] : counts.faces_by_size) print_count(face_name(size), number);
  print_count("holes", counts.holes);
  std::size_t without_limit = 0;
  for (int face = 0; face < surface.face_count(); ++face) without_limit += !surface.has_limit(face);
  print_count("without a limit surface (holes included)", without_limit);
}

void print_edges(const MeshCounts& counts) {
  print_heading("Edges");
  print_count("all", counts.edges);
  print_count("creases, infinitely sharp", counts.infinite_creases);
  print_count("creases, semi-sharp", counts.semi_sharp_creases);
  print_count("boundary", counts.boundary_edges);
  print_count("non-manifold", counts.non_manifold_edges);
}

void print_vertices(const MeshCounts& counts) {
  print_heading("Vertices");
  print_count("all", counts.vertices);
  print_count("smooth", counts.smooth);
  print_count("conical", counts.conical);
  print_count("dart", counts.dart);
  print_count("crease", counts.crease);
  print_count("corner", counts.corner);
  print_count("isolated", counts.isolated_vertices);
  print_count("on a boundary", counts.boundary_vertices);
  print_count("extraordinary", counts.extraordinary);
  print_count("tagged, infinitely sharp", counts.infinite_corners);
  print_count("tagged, semi-sharp", counts.semi_sharp_corners);
  print_heading("Vertices by valence (number of edges)");
  for (const auto& [valence, number] : counts.vertices_by_valence) print_count(std::to_string(valence), number);
}

/// What the paper's section 8.1 asks of every patch before it is traced by chord triangles.
void print_validity(const LimitSurface& surface) {
  const ValidityCounts counts = count_valid_parts(surface);
  print_heading("Patches, projected to their planes");
  print_count("all", counts.patches);
  print_count("may overlap themselves, so are split", counts.split);
  print_count("parts that they all come to", counts.parts);
  print_count("parts that still may overlap themselves", counts.unresolved);
}

void print_bounds(const ControlMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vec3& position : mesh.positions) box.extend(position);
  print_heading("Bounding box of the control points");
  print_point("lower", box.min());
  print_point("upper", box.max());
  std::printf("  %-8s %.9g\n", "diagonal", mesh.diagonal());
}

void print_warnings(const ControlMesh& mesh) {
  print_heading("Warnings");
  if (mesh.warnings.empty()) std::printf("  none\n");
  for (const std::string& warning : mesh.warnings) std::printf("  %s\n", warning.c_str());
}

}  // namespace

int info(const InfoOptions& options) {
  if (is_scene_file(options.model.file)) return scene_info(options.model);
  LoadedModel model = load_model(options.model);
  const std::string scheme = model.scheme;
  const std::unique_ptr<LimitSurface> surface = build_surface(std::move(model));
  const ControlMesh& mesh = surface->control_mesh();
  const MeshCounts counts = count(mesh, surface->triangular() ? 6 : 4);
  print_general(*surface, scheme, options.model);
  print_faces(counts, *surface);
  print_edges(counts);
  print_vertices(counts);
  print_validity(*surface);
  print_bounds(mesh);
  print_warnings(mesh);
  return exit_done;
}

void add_info(CLI::App& app, Command& command) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* sub =
      app.add_subcommand("info",
                         "Print counts of faces, edges and vertices by kind, the bounding box, and warnings; of a "
                         "scene, its objects and instances");
  add_stage_options(*sub, options->model);
  sub->callback([options, &command] { command = [options] { return info(*options); }; });
}

}  // namespace shaolin
