#pragma once
/// Questions that come as rows of numbers: from a CSV file, or one by one from the command line.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "schemes/vec3.h"
#include "tools/cli/csv.h"
#include "tools/cli/distinct_files.h"

namespace shaolin {

/// What a kind of question is called, and what its numbers are.
struct RowFormat {
  std::string name;                 ///< of the option for one: "point" stands for --point, and --points for a file
  std::string plural;               ///< of the option for a file
  std::string columns;              ///< "x,y,z"; all that there may be
  std::vector<std::size_t> counts;  ///< how many of them there may be, ascending
  std::string what;                 ///< one of them, in words, for help: "A point"
};

/// Two options that exclude each other, and their rows.
class RowInput {
 public:
  explicit RowInput(RowFormat format) : format_(std::move(format)) {}

  /// Adds the options --NAME and --PLURAL. They are parsed into this, which must outlive the parser.
  void add_options(CLI::App& app);

  const RowFormat& format() const { return format_; }
  bool is_given() const { return one_->count() + file_->count() > 0; }
  /// The file, if one is given, for the check that outputs are no inputs.
  std::vector<NamedFile> inputs() const;
  /// "--points or --point".
  std::string options() const { return "--" + format_.plural + " or --" + format_.name; }

  /// The rows; those of a file with their lines. Throws InputError for a file that is not as the format says.
  CsvTable read() const;

 private:
  RowFormat format_;
  std::filesystem::path path_;
  std::vector<std::vector<double>> rows_;
  CLI::Option* one_ = nullptr;
  CLI::Option* file_ = nullptr;
};

/// Checks a command line: rows must be given by exactly one of the inputs, and the output must be no input file,
/// `others` included. Throws CLI errors, which are usage errors. Returns the input that is given.
const RowInput& expect_rows(const std::vector<const RowInput*>& inputs, const std::filesystem::path& output,
                            std::vector<NamedFile> others);

/// Three numbers of a row as a vector.
Vec3 vector_at(std::span<const double> row, std::size_t first);

}  // namespace shaolin
