#include "tools/cli/row_input.h"

#include <algorithm>
#include <cmath>

#include "schemes/text.h"
#include "tools/cli/row_batch.h"

namespace shaolin {
namespace {

/// Finite numbers with commas between them; empty for anything else.
std::vector<double> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::optional<double> number = to_number(text.substr(0, comma));
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    text.remove_prefix(comma + 1);
  }
}

/// "x,y[,z]": columns after the first so many are in brackets.
std::string with_brackets(const std::string& columns, const std::vector<std::size_t>& counts) {
  std::string text;
  std::size_t column = 0;
  for (const char c : columns) {
    if (c == ',' && std::find(counts.begin(), counts.end(), ++column) != counts.end()) text += '[';
    text += c;
  }
  return text + std::string(counts.size() - 1, ']');
}

}  // namespace

void RowInput::add_options(CLI::App& app) {
  const std::string columns = with_brackets(format_.columns, format_.counts);
  file_ =
      app.add_option("--" + format_.plural, path_, "CSV file with the columns " + columns + "; a header is optional")
          ->type_name("FILE");
  std::string type = columns;
  std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::toupper(c); });
  one_ = app.add_option_function<std::vector<std::string>>(
                "--" + format_.name,
                [this, columns](const std::vector<std::string>& texts) {
                  for (const std::string& text : texts) {
                    rows_.push_back(parse_numbers(text));
                    if (std::find(format_.counts.begin(), format_.counts.end(), rows_.back().size()) ==
                        format_.counts.end())
                      throw CLI::ValidationError("--" + format_.name,
                                                 "'" + text + "' is not " + columns + ": finite numbers");
                  }
                },
                format_.what + ", instead of a file; may be given again")
             ->type_name(type)
             ->allow_extra_args(false)
             ->excludes(file_);
}

std::vector<NamedFile> RowInput::inputs() const {
  if (file_->count() == 0) return {};
  return {{"--" + format_.plural, path_}};
}

CsvTable RowInput::read() const {
  if (file_->count() > 0) {
    CsvTable table = read_csv(path_, format_.counts);
    check_header(table, path_.string(), format_.columns);
    return table;
  }
  CsvTable table("--" + format_.name);
  int number = 0;
  for (const std::vector<double>& row : rows_) table.add_row(row, ++number);
  return table;
}

const RowInput& expect_rows(const std::vector<const RowInput*>& inputs, const std::filesystem::path& output,
                            std::vector<NamedFile> others) {
  const RowInput* given = nullptr;
  std::string all;
  for (const RowInput* input : inputs) {
    all += (all.empty() ? "" : " or ") + input->options();
    if (!input->is_given()) continue;
    if (given) throw CLI::ValidationError(input->options() + " and " + given->options() + " exclude each other");
    given = input;
    for (const NamedFile& file : input->inputs()) others.push_back(file);
  }
  if (!given) throw CLI::RequiredError(all);
  expect_distinct_files({{"--output", output}}, others);
  return *given;
}

Vec3 vector_at(std::span<const double> row, std::size_t first) { return {row[first], row[first + 1], row[first + 2]}; }

}  // namespace shaolin
