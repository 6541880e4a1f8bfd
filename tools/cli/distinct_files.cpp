#include "tools/cli/distinct_files.h"

#include <CLI/CLI.hpp>
#include <system_error>

namespace shaolin {
namespace {

namespace fs = std::filesystem;

/// Absolute, without dots, links resolved as far as the path exists.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  const fs::path canonical = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : canonical;
}

bool are_one_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;
  if (const fs::file_status status = fs::status(a, error); fs::exists(status) && !fs::is_regular_file(status))
    return false;
  return resolved(a) == resolved(b) || fs::equivalent(a, b, error);
}

}  // namespace

void expect_distinct_files(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  const auto expect_distinct = [](const NamedFile& output, const NamedFile& other) {
    if (are_one_file(output.file, other.file))
      throw CLI::ValidationError(output.option,
                                 "'" + output.file.string() + "' is the file of " + other.option + ", too");
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) expect_distinct(outputs[i], outputs[k]);
    for (const NamedFile& input : inputs) expect_distinct(outputs[i], input);
  }
}

}  // namespace shaolin
