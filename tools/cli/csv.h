#pragma once
/// Tables of numbers as comma-separated values.
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/cli/output_file.h"

namespace shaolin {

/// Rows of numbers, each with the line (from 1) where it stands in its file.
class CsvTable {
 public:
  explicit CsvTable(std::string file) : file_(std::move(file)) {}

  std::size_t row_count() const { return lines_.size(); }
  /// The numbers of a row as they were written, NaN and infinities included: which of them make sense is for the caller
  /// to say, by fail().
  std::span<const double> row(std::size_t row) const {
    return {values_.data() + offsets_[row], offsets_[row + 1] - offsets_[row]};
  }
  int line(std::size_t row) const { return lines_[row]; }
  const std::vector<std::string>& header() const { return header_; }  ///< empty if the file has none
  int header_line() const { return header_line_; }

  /// A number that must be an integer in the range of int. Throws InputError with file and line if it is not.
  int integer(std::size_t row, std::size_t column) const;

  /// Throws InputError with the file and the row's line.
  [[noreturn]] void fail(std::size_t row, const std::string& message) const;

  void set_header(std::vector<std::string> names, int line) { header_ = std::move(names), header_line_ = line; }
  void add_row(std::span<const double> values, int line);

 private:
  std::string file_;
  std::vector<std::string> header_;
  int header_line_ = 0;
  std::vector<double> values_;
  std::vector<std::size_t> offsets_{0};
  std::vector<int> lines_;
};

/// Reads a file of rows with any of the given numbers of columns. The first row is a header if its first field is not
/// a number; then none of its fields may be one, so that a spoilt first row is not taken for a header, and every row
/// must be as long as it is. Blank lines, CR before LF and blanks around fields are skipped; '#' and '"' have no
/// meaning; "inf" and "nan" are numbers.
/// Throws InputError with file and line for a row of another length or a field that is no number. O(file size).
CsvTable read_csv(const std::filesystem::path& file, const std::vector<std::size_t>& column_counts);

/// The same from a stream; `name` stands for the file in messages.
CsvTable read_csv(std::istream& stream, const std::string& name, const std::vector<std::size_t>& column_counts);

/// The name that stands for the standard output.
inline constexpr const char* standard_output = "-";

/// Writes a table field by field. The file appears on commit(); without it, nothing is left behind.
class CsvWriter {
 public:
  /// `file` may be `standard_output`. `header` holds the names of the columns, "a,b,c". Throws InputError as OutputFile
  /// does.
  CsvWriter(std::filesystem::path file, std::string_view header);

  CsvWriter& field(double value);     ///< 17 significant digits, as printf's %.17g in the C locale
  CsvWriter& field(long long value);  ///< an integer
  CsvWriter& field(int value) { return field(static_cast<long long>(value)); }
  CsvWriter& field(std::string_view name);  ///< as it is: without commas, quotes and line ends
  CsvWriter& empty(int count = 1);          ///< fields without content

  /// Ends the row, which must have as many fields as the header.
  void end_row();

  /// Completes the file and puts it in its place. Throws InputError if it could not be written (a full disk).
  void commit();

 private:
  void begin_field();
  std::ostream& stream();
  void flush();

  std::string name_;
  std::optional<OutputFile> output_;  ///< empty: the standard output
  std::ofstream file_;
  std::string buffer_;
  int columns_ = 0;
  int fields_ = 0;  ///< in the current row so far
};

}  // namespace shaolin
