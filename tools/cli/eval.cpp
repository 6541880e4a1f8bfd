#include "tools/cli/eval.h"

#include <memory>
#include <optional>
#include <string_view>

#include "tools/cli/csv_vector.h"
#include "tools/cli/distinct_files.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/threads.h"

namespace shaolin {
namespace {

constexpr std::string_view parameter_columns = "face,sub,u,v";
constexpr std::string_view output_columns =
    "face,sub,u,v,px,py,pz,nx,ny,nz,dux,duy,duz,dvx,dvy,dvz,duux,duuy,duuz,duvx,duvy,duvz,dvvx,dvvy,dvvz";
constexpr int point_columns = 6;        // position, normal
constexpr int derivative_columns = 15;  // du, dv, duu, duv, dvv

SurfaceParameter to_parameter(const CsvTable& table, std::size_t row) {
  SurfaceParameter at;
  at.face = table.integer(row, 0);
  at.sub = table.integer(row, 1);
  at.u = table.row(row)[2];
  at.v = table.row(row)[3];
  return at;
}

void write_sample(CsvWriter& writer, const LimitSample& sample) {
  write_vector(writer, sample.position);
  write_normal(writer, sample.normal);
  if (!sample.derivatives) {
    writer.empty(derivative_columns);
    return;
  }
  const Derivatives& d = *sample.derivatives;
  for (const Vec3& derivative : {d.du, d.dv, d.duu, d.duv, d.dvv}) write_derivative(writer, derivative);
}

void write_row(CsvWriter& writer, const SurfaceParameter& at, const std::optional<LimitSample>& sample) {
  writer.field(at.face).field(at.sub).field(at.u).field(at.v);
  if (sample)
    write_sample(writer, *sample);
  else
    writer.empty(point_columns + derivative_columns);
  writer.end_row();
}

void eval_in_arena(const EvalOptions& options) {
  LoadedModel model = load_model(options.model);
  const CsvTable table = read_csv(options.parameters, {4});
  check_header(table, options.parameters.string(), parameter_columns);

  std::vector<SurfaceParameter> parameters(table.row_count());
  for (std::size_t row = 0; row < parameters.size(); ++row) parameters[row] = to_parameter(table, row);

  const std::unique_ptr<LimitSurface> surface = build_surface(std::move(model));
  CsvWriter writer(options.output, output_columns);
  process_rows(
      table, [&](std::size_t row) { return surface->evaluate(parameters[row]); },
      [&](std::size_t row, const std::optional<LimitSample>& sample) { write_row(writer, parameters[row], sample); });
  writer.commit();
}

}  // namespace

int eval(const EvalOptions& options) {
  run_with_threads(options.threads, [&options] { eval_in_arena(options); });
  return exit_done;
}

void add_eval(CLI::App& app, Command& command) {
  const auto options = std::make_shared<EvalOptions>();
  CLI::App* sub = app.add_subcommand("eval", "Evaluate the limit surface at parameters from a CSV file");
  add_model_options(*sub, options->model);
  sub->add_option(
         "--params", options->parameters,
         "CSV file with the columns face,sub,u,v; a header is optional. Faces count from 0; sub is the corner of "
         "an n-gon, else 0; u and v lie in [0, 1] (u + v <= 1 on Loop's triangles)")
      ->required()
      ->type_name("FILE");
  sub->add_option("-o,--output", options->output,
                  "CSV file with one row per parameter, in order: face,sub,u,v, the position px,py,pz, the unit normal "
                  "nx,ny,nz, and the derivatives du, dv, duu, duv, dvv (dux,duy,duz,...). The derivatives are empty at "
                  "irregular vertices and of schemes without polynomials, the normal where the surface has none (on a "
                  "face that is a segment or a point); everything after v is empty on faces without a limit surface")
      ->required()
      ->type_name("FILE");
  add_threads_option(*sub, options->threads);
  sub->callback([options, &command] {
    std::vector<NamedFile> inputs = inputs_of(options->model);
    inputs.push_back({"--params", options->parameters});
    expect_distinct_files({{"--output", options->output}}, inputs);
    command = [options] { return eval(*options); };
  });
}

}  // namespace shaolin
