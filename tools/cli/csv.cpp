#include "tools/cli/csv.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>
#include <utility>

#include "schemes/errors.h"
#include "schemes/text.h"

namespace shaolin {

namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Splits the line into trimmed fields; `fields` is an argument so that its memory serves every line.
void split(std::string_view line, std::vector<std::string_view>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    fields.push_back(trimmed(line.substr(begin, comma - begin)));
    begin = comma + 1;
  }
}

class CsvReader {
 public:
  CsvReader(const std::string& name, const std::vector<std::size_t>& column_counts)
      : name_(name), column_counts_(column_counts), table_(name) {}

  CsvTable read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      read_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(message, name_, line_); }

  void read_line(std::string_view line) {
    if (trimmed(line).empty()) return;
    split(line, fields_);
    if (std::find(column_counts_.begin(), column_counts_.end(), fields_.size()) == column_counts_.end()) {
      fail("a row with " + std::to_string(fields_.size()) + " columns, expected " + expected_columns());
    }
    const bool may_be_header = std::exchange(is_first_, false) && !fields_[0].empty() && !to_number(fields_[0]);
    if (may_be_header && std::none_of(fields_.begin(), fields_.end(), to_number)) {
      table_.set_header({fields_.begin(), fields_.end()}, line_);
      return;
    }
    if (!table_.header().empty() && fields_.size() != table_.header().size()) {
      fail("a row with " + std::to_string(fields_.size()) + " columns, expected " +
           std::to_string(table_.header().size()) + " as in the header");
    }
    values_.clear();
    for (const std::string_view field : fields_) {
      const std::optional<double> value = to_number(field);
      if (!value) {
        fail("column " + std::to_string(values_.size() + 1) + ": " + quoted(field) + " is not a number, expected " +
             expected_columns() + " numbers");
      }
      values_.push_back(*value);
    }
    table_.add_row(values_, line_);
  }

  /// "6 or 8"
  std::string expected_columns() const {
    std::string text;
    for (const std::size_t count : column_counts_) text += (text.empty() ? "" : " or ") + std::to_string(count);
    return text;
  }

  const std::string& name_;
  const std::vector<std::size_t>& column_counts_;
  CsvTable table_;
  int line_ = 0;
  bool is_first_ = true;
  std::vector<std::string_view> fields_;
  std::vector<double> values_;
};

}  // namespace

int CsvTable::integer(std::size_t row_index, std::size_t column) const {
  const double value = row(row_index)[column];
  if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::floor(value)) {
    fail(row_index, "column " + std::to_string(column + 1) + ": " + std::to_string(value) + " is not an integer");
  }
  return static_cast<int>(value);
}

void CsvTable::fail(std::size_t row_index, const std::string& message) const {
  throw InputError(message, file_, lines_[row_index]);
}

void CsvTable::add_row(std::span<const double> values, int line) {
  values_.insert(values_.end(), values.begin(), values.end());
  offsets_.push_back(values_.size());
  lines_.push_back(line);
}

CsvTable read_csv(const std::filesystem::path& file, const std::vector<std::size_t>& column_counts) {
  const std::string text = read_text_file(file);
  return CsvReader(file.string(), column_counts).read(text);
}

CsvTable read_csv(std::istream& stream, const std::string& name, const std::vector<std::size_t>& column_counts) {
  const std::string text = read_text(stream, name);
  return CsvReader(name, column_counts).read(text);
}

CsvWriter::CsvWriter(std::filesystem::path file, std::string_view header)
    : name_(file.string()),
      buffer_(header),
      columns_(1 + static_cast<int>(std::count(header.begin(), header.end(), ','))) {
  buffer_ += '\n';
  if (file == standard_output) return;
  output_.emplace(std::move(file));
  file_.open(output_->path(), std::ios::binary | std::ios::trunc);
}

void CsvWriter::begin_field() {
  if (fields_++ > 0) buffer_ += ',';
}

CsvWriter& CsvWriter::field(double value) {
  begin_field();
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 17).ptr;
  buffer_.append(text.data(), end);
  return *this;
}

CsvWriter& CsvWriter::field(long long value) {
  begin_field();
  buffer_ += std::to_string(value);
  return *this;
}

CsvWriter& CsvWriter::field(std::string_view name) {
  assert(name.find_first_of(",\"\r\n") == std::string_view::npos);
  begin_field();
  buffer_ += name;
  return *this;
}

CsvWriter& CsvWriter::empty(int count) {
  for (int i = 0; i < count; ++i) begin_field();
  return *this;
}

void CsvWriter::end_row() {
  assert(fields_ == columns_);
  fields_ = 0;
  buffer_ += '\n';
  constexpr std::size_t block = std::size_t{1} << 20;
  if (buffer_.size() >= block) flush();
}

std::ostream& CsvWriter::stream() { return output_ ? static_cast<std::ostream&>(file_) : std::cout; }

void CsvWriter::flush() {
  stream().write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void CsvWriter::commit() {
  flush();
  if (output_)
    file_.close();
  else
    std::cout.flush();
  if (!stream()) throw InputError("cannot be written completely (is the disk full?)", name_);
  if (output_) output_->commit();
}

}  // namespace shaolin
