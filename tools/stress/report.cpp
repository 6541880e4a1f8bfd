#include "tools/stress/report.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include "tools/bench/report_folder.h"
#include "tools/cli/csv.h"
#include "tools/cli/json_text.h"
#include "tools/validate/agreement.h"

namespace shaolin::stress {

namespace {

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

std::vector<std::string> cells(const std::string& name, const Tally& tally) {
  const auto share = tally.uncertified_share();
  std::vector<std::string> result{name, std::to_string(tally.rays), std::to_string(tally.hits)};
  for (const std::size_t wrong : tally.wrong) result.push_back(std::to_string(wrong));
  result.push_back(std::to_string(tally.undecided));
  result.push_back(rounded(tally.worst_error));
  result.push_back(share ? rounded(100 * *share) + " %" : "-");
  result.push_back(share ? std::to_string(tally.count(Unproven::other)) : "-");
  return result;
}

Json json_of(const Tally& tally) {
  Json json{{"rays", tally.rays},
            {"hits", tally.hits},
            {"lost", tally.count(Fault::lost)},
            {"ghosts", tally.count(Fault::ghost)},
            {"duplicates", tally.count(Fault::duplicate)},
            {"undecided", tally.undecided},
            {"worst_error_ulp", tally.worst_error}};
  const auto share = tally.uncertified_share();
  json["uncertified_share"] = share ? Json(*share) : Json();
  json["certified"] = tally.certified;
  json["uncertified"] = {{"boundary", tally.count(Unproven::boundary)},
                         {"flat", tally.count(Unproven::flat)},
                         {"other", tally.count(Unproven::other)}};
  return json;
}

/// A NaN or an infinity is a word in JSON.
Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(exact(value)); }

Json json_of(const Ray& ray) {
  Json origin = Json::array(), direction = Json::array();
  for (const double x : ray.origin) origin.push_back(json_of(x));
  for (const double x : ray.direction) direction.push_back(json_of(x));
  return {{"origin", origin}, {"direction", direction}, {"tmin", json_of(ray.tmin)}, {"tmax", json_of(ray.tmax)}};
}

Json json_of(const Result& result, const RunOptions& options) {
  Json json{{"passed", result.passed()},
            {"seed", options.seed},
            {"rays_of_each", result.rays},
            {"seconds", result.seconds},
            {"total", json_of(result.total())}};
  if (result.slowdown > 0) json["bad_number_slowdown"] = result.slowdown;
  for (const char* key : {"families", "rows", "failures"}) json[key] = Json::array();
  for (const Row& row : result.by_family()) {
    Json entry{{"family", row.family}};
    entry.update(json_of(row.tally));
    json["families"].push_back(entry);
  }
  for (const Row& row : result.rows) {
    Json entry{{"family", row.family}, {"model", row.model}};
    entry.update(json_of(row.tally));
    json["rows"].push_back(entry);
    for (const Failure& failure : row.tally.failures)
      json["failures"].push_back({{"family", failure.family},
                                  {"model", failure.model},
                                  {"variant", failure.variant},
                                  {"fault", name_of(failure.fault)},
                                  {"ray", json_of(failure.ray)},
                                  {"detail", failure.detail}});
  }
  return json;
}

void write_rows(const std::filesystem::path& file, const Result& result) {
  CsvWriter csv(
      file,
      "family,model,rays,hits,lost,ghosts,duplicates,undecided,worst_error_ulp,uncertified_share,unexplained,seconds");
  for (const Row& row : result.rows) {
    csv.field(row.family).field(row.model);
    csv.field(static_cast<long long>(row.tally.rays)).field(static_cast<long long>(row.tally.hits));
    for (const std::size_t wrong : row.tally.wrong) csv.field(static_cast<long long>(wrong));
    csv.field(static_cast<long long>(row.tally.undecided)).field(row.tally.worst_error);
    const auto share = row.tally.uncertified_share();
    if (share)
      csv.field(*share);
    else
      csv.empty();
    csv.field(static_cast<long long>(row.tally.count(Unproven::other))).field(row.seconds).end_row();
  }
  csv.commit();
}

CsvWriter& ray_fields(CsvWriter& csv, const Ray& ray) {
  for (const double x : ray.origin) csv.field(x);
  for (const double x : ray.direction) csv.field(x);
  return csv.field(ray.tmin).field(ray.tmax);
}

void write_failures(const std::filesystem::path& file, const Result& result) {
  CsvWriter csv(file, "family,model,variant,fault,ox,oy,oz,dx,dy,dz,tmin,tmax,detail");
  const auto as_field = [](std::string text) {
    std::replace(text.begin(), text.end(), ',', ';');
    return text;
  };
  for (const Row& row : result.rows)
    for (const Failure& failure : row.tally.failures) {
      csv.field(failure.family).field(failure.model).field(as_field(failure.variant)).field(name_of(failure.fault));
      ray_fields(csv, failure.ray).field(as_field(failure.detail)).end_row();
    }
  csv.commit();
}

void write_peers(const std::filesystem::path& file, const TextTable& table) {
  std::string header;
  for (const std::string& name : table.header) header += (header.empty() ? "" : ",") + name;
  CsvWriter csv(file, header);
  for (const auto& row : table.rows) {
    for (std::string cell : row) {
      std::erase(cell, ',');
      csv.field(cell);
    }
    csv.end_row();
  }
  csv.commit();
}

}  // namespace

TextTable table_of(const Result& result) {
  TextTable table;
  table.header = {"family",     "rays",      "hits",      "lost",        "ghosts",
                  "duplicates", "undecided", "worst ulp", "uncertified", "unexplained"};
  for (const Row& row : result.by_family()) table.rows.push_back(cells(row.family, row.tally));
  table.rows.push_back(cells("all", result.total()));
  return table;
}

void print(std::ostream& out, const Result& result, std::uint64_t seed) {
  constexpr std::size_t most_shown = 5;
  write_markdown(out, table_of(result));
  out << "\nthe same again: --seed " << seed << " --rays " << result.rays << " (of each family at each model)\n";
  if (result.slowdown > 0)
    out << "bad numbers take " << rounded(result.slowdown) << " times a ray's time (at most "
        << rounded(Result::most_slowdown) << ")\n";
  for (const Row& row : result.rows)
    for (std::size_t i = 0; i < std::min(most_shown, row.tally.failures.size()); ++i) {
      const Failure& failure = row.tally.failures[i];
      out << name_of(failure.fault) << ": " << row.family << ", " << row.model
          << (failure.variant.empty() ? "" : " " + failure.variant) << ": " << exact(failure.ray) << "\n    "
          << failure.detail << '\n';
    }
  out << (result.passed() ? "PASS" : "FAIL") << '\n';
}

void write_report(const std::filesystem::path& folder, const Result& result, const RunOptions& options) {
  make_report_folder(folder);
  write_rows(folder / "stress.csv", result);
  write_failures(folder / "failures.csv", result);
  if (options.peers) write_peers(folder / "peers.csv", options.peers->table());
  write_page(folder / "stress.json", [&](std::ostream& out) { out << json_of(result, options).dump(1) << '\n'; });
}

}  // namespace shaolin::stress
