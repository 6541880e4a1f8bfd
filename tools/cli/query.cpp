#include "tools/cli/query.h"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "tools/cli/csv.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr std::string_view ray_columns = "ox,oy,oz,dx,dy,dz,tmin,tmax";
constexpr std::string_view hit_columns = "ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz";
constexpr int columns_of_a_miss = 2;  // ray, hit
constexpr int columns_of_a_hit = 13;

CsvTable read_rays(const std::filesystem::path& file) {
  CsvTable table = read_csv(file, {6, 8});
  check_header(table, file.string(), ray_columns);
  return table;
}

Ray to_ray(std::span<const double> row) {
  Ray ray;
  ray.origin = {row[0], row[1], row[2]};
  ray.direction = {row[3], row[4], row[5]};
  if (row.size() == 8) {
    ray.tmin = row[6];
    ray.tmax = row[7];
  }
  return ray;
}

/// The row's first two fields; the rest stays empty.
void write_answer(CsvWriter& writer, std::size_t ray, bool hit) {
  writer.field(static_cast<long long>(ray)).field(hit ? 1 : 0);
}

void write_hit(CsvWriter& writer, const Hit& hit) {
  writer.field(hit.t).field(hit.at.face).field(hit.at.sub).field(hit.at.u).field(hit.at.v);
  for (const Vec3& vector : {hit.sample.position, hit.sample.normal})
    for (int axis = 0; axis < 3; ++axis) writer.field(vector[axis]);
}

void query_closest(const Scene& scene, const CsvTable& rays, CsvWriter& writer) {
  process_rows(
      rays, [&](std::size_t row) { return scene.intersect(to_ray(rays.row(row))); },
      [&](std::size_t row, const std::optional<Hit>& hit) {
        write_answer(writer, row, hit.has_value());
        if (hit)
          write_hit(writer, *hit);
        else
          writer.empty(columns_of_a_hit - columns_of_a_miss);
        writer.end_row();
      });
}

void query_any(const Scene& scene, const CsvTable& rays, CsvWriter& writer) {
  // char, as std::vector<bool> shares bytes between threads.
  process_rows(
      rays, [&](std::size_t row) { return static_cast<char>(scene.occluded(to_ray(rays.row(row)))); },
      [&](std::size_t row, char hit) {
        write_answer(writer, row, hit != 0);
        writer.empty(columns_of_a_hit - columns_of_a_miss);
        writer.end_row();
      });
}

void query_in_arena(const QueryOptions& options) {
  Model model = load_model(options.model);
  const CsvTable rays = read_rays(options.rays);
  const Scene scene = build_scene(std::move(model), options.scene);
  CsvWriter writer(options.hits, hit_columns);
  if (options.any)
    query_any(scene, rays, writer);
  else
    query_closest(scene, rays, writer);
  writer.commit();
}

}  // namespace

int query(const QueryOptions& options) {
  run_with_threads(options.threads, [&options] { query_in_arena(options); });
  return exit_done;
}

void add_query(CLI::App& app, Command& command) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App* sub = app.add_subcommand("query", "Intersect rays from a CSV file with the limit surface");
  add_model_options(*sub, options->model);
  add_method_option(*sub, options->scene);
  sub->add_option("--rays", options->rays,
                  "CSV file with the columns ox,oy,oz,dx,dy,dz[,tmin,tmax]; a header is optional. Directions need not "
                  "be unit; t is in units of their length")
      ->required()
      ->type_name("FILE");
  sub->add_option(
         "-o,--output", options->hits,
         "CSV file with one row per ray, in order: ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz; on a miss, hit is "
         "0 and the fields after it are empty")
      ->required()
      ->type_name("FILE");
  sub->add_flag("--any", options->any,
                "Ask only whether a ray hits anything, which is cheaper: the columns stay, all fields after hit are "
                "empty, as no closest point is known");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return query(*options); }; });
}

}  // namespace shaolin
