#include "tools/cli/query.h"

#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include "schemes/errors.h"
#include "tools/cli/csv_vector.h"
#include "tools/cli/distinct_files.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/stage.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr std::string_view ray_columns = "ox,oy,oz,dx,dy,dz,tmin,tmax";
constexpr std::string_view hit_columns = "ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz,certified,residual,error";
using Asked = QueryOptions::Answer;

CsvTable parse_rays(const std::vector<std::string>& texts) {
  CsvTable table("--ray");
  for (const std::string& text : texts) {
    std::istringstream line(text);
    const CsvTable one = read_csv(line, "'" + text + "'", {6, 8});
    if (one.row_count() != 1)
      throw InputError("'" + text + "' is not one ray: ox,oy,oz,dx,dy,dz, and tmin,tmax or not");
    table.add_row(one.row(0), static_cast<int>(table.row_count()) + 1);
  }
  return table;
}

CsvTable read_rays(const QueryOptions& options) {
  if (options.file.empty()) return parse_rays(options.rays);
  CsvTable table = read_csv(options.file, {6, 8});
  check_header(table, options.file.string(), ray_columns);
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

std::string columns(Asked answer, bool instances) {
  if (answer == Asked::count) return "ray,count";
  std::string all(hit_columns);
  if (answer == Asked::all) all += ",sense";
  if (instances) all += ",instance";
  return all;
}

/// Answers as rows; those of a scene file have one column more.
class HitWriter {
 public:
  HitWriter(const std::filesystem::path& file, Asked answer, bool instances)
      : writer_(file, columns(answer, instances)), senses_(answer == Asked::all), instances_(instances) {}

  /// A row of which only the first two fields are known. (Of char, as std::vector<bool> shares bytes between threads.)
  void write(std::size_t ray, char hit) {
    writer_.field(static_cast<long long>(ray)).field(hit).empty(14 + senses_ + instances_).end_row();
  }

  void write(std::size_t ray, const std::optional<Hit>& hit) {
    if (!hit) return write(ray, char{0});
    begin_row(ray, 1, *hit);
    end_row(*hit);
  }

  /// A row for each, numbered from 1.
  void write(std::size_t ray, const std::vector<Crossing>& all) {
    if (all.empty()) return write(ray, char{0});
    int number = 0;
    for (const Crossing& crossing : all) {
      begin_row(ray, ++number, crossing.hit);
      writer_.field(static_cast<int>(crossing.sense));
      end_row(crossing.hit);
    }
  }

  void write(std::size_t ray, std::size_t count) {
    writer_.field(static_cast<long long>(ray)).field(static_cast<long long>(count)).end_row();
  }

  void commit() { writer_.commit(); }

  /// Of the hits written.
  std::uint64_t uncertified() const { return uncertified_; }

 private:
  void begin_row(std::size_t ray, int number, const Hit& hit) {
    writer_.field(static_cast<long long>(ray)).field(number);
    writer_.field(hit.t).field(hit.at.face).field(hit.at.sub).field(hit.at.u).field(hit.at.v);
    write_vector(writer_, hit.sample.position);
    write_normal(writer_, hit.sample.normal);
    const Certificate& certificate = hit.certificate;
    uncertified_ += !certificate.is_certified();
    writer_.field(certificate.is_certified() ? 1 : 0).field(certificate.residual);
    if (certificate.is_certified())
      writer_.field(certificate.error);
    else
      writer_.empty();
  }
  void end_row(const Hit& hit) {
    if (instances_) writer_.field(hit.instance);
    writer_.end_row();
  }

  CsvWriter writer_;
  bool senses_, instances_;
  std::uint64_t uncertified_ = 0;
};

/// `ask` gives what HitWriter writes.
template <class Ask>
void answer_all(const CsvTable& rays, HitWriter& writer, Ask ask) {
  process_rows(
      rays, [&](std::size_t row) { return ask(to_ray(rays.row(row))); },
      [&](std::size_t row, const auto& answer) { writer.write(row, answer); });
}

void query_in_arena(const QueryOptions& options) {
  Stage stage = load_stage(options.model);
  const CsvTable rays = read_rays(options);
  const Scene scene = build_scene(stage, options.scene);
  HitWriter writer(options.hits, options.answer, stage.is_scene);
  switch (options.answer) {
    case Asked::closest:
      answer_all(rays, writer, [&](const Ray& ray) {
        std::optional<Hit> hit = scene.intersect(ray);
        if (hit) hit->certificate = scene.certify(ray, *hit);
        return hit;
      });
      break;
    case Asked::any:
      answer_all(rays, writer, [&](const Ray& ray) { return static_cast<char>(scene.occluded(ray)); });
      break;
    case Asked::all:
      answer_all(rays, writer, [&](const Ray& ray) {
        std::vector<Crossing> all = scene.all_hits(ray);
        for (Crossing& crossing : all) crossing.hit.certificate = scene.certify(ray, crossing.hit);
        return all;
      });
      break;
    case Asked::count:
      answer_all(rays, writer, [&](const Ray& ray) { return scene.count(ray); });
      break;
  }
  writer.commit();
  const Statistics statistics = scene.statistics();
  // Of hits that are not written, what the rays were given counts.
  const bool are_written = options.answer == Asked::closest || options.answer == Asked::all;
  std::cerr << statistics.rays << " rays, " << statistics.hits << " with a hit, "
            << (are_written ? writer.uncertified() : statistics.uncertified) << " hits not certified\n";
  report_budget(scene, options.scene);
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
  CLI::Option_group* const rays = sub->add_option_group("Rays");
  rays->add_option("--rays", options->file,
                   "CSV file with the columns ox,oy,oz,dx,dy,dz[,tmin,tmax]; a header is optional. Directions need not "
                   "be unit; t is in units of their length")
      ->type_name("FILE");
  rays->add_option_function<std::vector<std::string>>(
          "--ray",
          [options](const std::vector<std::string>& texts) {
            try {
              parse_rays(texts);
            } catch (const InputError& error) {
              throw CLI::ValidationError("--ray", error.what());
            }
            options->rays = texts;
          },
          "A ray, instead of a file; may be given again")
      ->type_name("OX,OY,OZ,DX,DY,DZ[,TMIN,TMAX]")
      ->allow_extra_args(false);
  rays->require_option(1);
  sub->add_option(
         "-o,--output", options->hits,
         "CSV file with one row per ray, in order: ray,hit,t,face,sub,u,v,px,py,pz,nx,ny,nz,certified,residual,error; "
         "on a miss, hit is 0 and the fields after it are empty; the normal is empty where the surface has none. Where "
         "certified is 1 there is one crossing, proven to be no farther than error from the position; the position is "
         "residual away from the ray. Of scenes with one more column, instance, which counts from 0 in the file's "
         "order "
         "with groups dissolved. By default, and for '-', the standard output")
      ->type_name("FILE");
  const auto add_answer = [&](const char* name, Asked answer, const char* help) {
    return sub->add_flag_callback(
        name, [options, answer] { options->answer = answer; }, help);
  };
  CLI::Option* const any = add_answer(
      "--any", Asked::any,
      "Ask only whether a ray hits anything, which is cheaper: the columns stay, all fields after hit are empty, as no "
      "closest point is known");
  CLI::Option* const all =
      add_answer("--all", Asked::all,
                 "All hits, in ascending order of t: a row for each, hit counts from 1, and one column more, sense: -1 "
                 "where the ray "
                 "enters (against the normal), 1 where it leaves, 0 where it touches and stays on its side");
  CLI::Option* const count = add_answer(
      "--count", Asked::count,
      "How many hits are crossings, which is odd from inside of a closed surface: the columns are ray,count");
  any->excludes(all)->excludes(count);
  all->excludes(count);
  for (const char* method : {"--uniform", "--chord", "--a3"})
    for (CLI::Option* const answer : {all, count}) answer->excludes(sub->get_option(method));
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    std::vector<NamedFile> inputs = inputs_of(options->model);
    inputs.push_back({"--rays", options->file});
    expect_distinct_files({{"--output", options->hits}}, inputs);
    command = [options] { return query(*options); };
  });
}

}  // namespace shaolin
