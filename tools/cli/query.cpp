#include "tools/cli/query.h"

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "tools/cli/csv.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/stage.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr std::string_view ray_columns = "ox,oy,oz,dx,dy,dz,tmin,tmax";
constexpr std::string_view hit_columns = "ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz";
constexpr std::string_view scene_hit_columns = "ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz,instance";

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

/// Answers as rows; those of a scene file have one column more.
class HitWriter {
 public:
  HitWriter(const std::filesystem::path& file, bool instances)
      : writer_(file, instances ? scene_hit_columns : hit_columns), instances_(instances) {}

  /// A row of which only the first two fields are known.
  void write(std::size_t ray, bool hit) {
    writer_.field(static_cast<long long>(ray)).field(hit ? 1 : 0).empty(instances_ ? 12 : 11).end_row();
  }

  void write(std::size_t ray, const std::optional<Hit>& hit) {
    if (!hit) return write(ray, false);
    writer_.field(static_cast<long long>(ray)).field(1);
    writer_.field(hit->t).field(hit->at.face).field(hit->at.sub).field(hit->at.u).field(hit->at.v);
    for (const Vec3& vector : {hit->sample.position, hit->sample.normal})
      for (int axis = 0; axis < 3; ++axis) writer_.field(vector[axis]);
    if (instances_) writer_.field(hit->instance);
    writer_.end_row();
  }

  void commit() { writer_.commit(); }

 private:
  CsvWriter writer_;
  bool instances_;
};

void query_closest(const Scene& scene, const CsvTable& rays, HitWriter& writer) {
  process_rows(
      rays, [&](std::size_t row) { return scene.intersect(to_ray(rays.row(row))); },
      [&](std::size_t row, const std::optional<Hit>& hit) { writer.write(row, hit); });
}

void query_any(const Scene& scene, const CsvTable& rays, HitWriter& writer) {
  // char, as std::vector<bool> shares bytes between threads.
  process_rows(
      rays, [&](std::size_t row) { return static_cast<char>(scene.occluded(to_ray(rays.row(row)))); },
      [&](std::size_t row, char hit) { writer.write(row, hit != 0); });
}

void query_in_arena(const QueryOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable rays = read_rays(options.rays);
  const Scene scene = build_scene(stage, options.scene);
  HitWriter writer(options.hits, stage.is_scene);
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
  add_stage_options(*sub, options->model);
  add_method_options(*sub, options->scene);
  sub->add_option("--rays", options->rays,
                  "CSV file with the columns ox,oy,oz,dx,dy,dz[,tmin,tmax]; a header is optional. Directions need not "
                  "be unit; t is in units of their length")
      ->required()
      ->type_name("FILE");
  sub->add_option(
         "-o,--output", options->hits,
         "CSV file with one row per ray, in order: ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz; on a miss, hit is "
         "0 and the fields after it are empty. Of scenes with one more column, instance, which counts from 0 in the "
         "file's order with groups dissolved")
      ->required()
      ->type_name("FILE");
  sub->add_flag("--any", options->any,
                "Ask only whether a ray hits anything, which is cheaper: the columns stay, all fields after hit are "
                "empty, as no closest point is known");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] { command = [options] { return query(*options); }; });
}

}  // namespace shaolin
