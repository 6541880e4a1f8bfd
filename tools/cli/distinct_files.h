#pragma once
/// Files of one command line that must not be one file.
#include <filesystem>
#include <string>
#include <vector>

namespace shaolin {

/// An option or a positional, and the file that it names; empty: it was not given.
struct NamedFile {
  std::string option;
  std::filesystem::path file;
};

/// Throws CLI::ValidationError, a usage error, if an output names the same file as another output or an input, however
/// both are spelt: one would replace the other. Devices and pipes are nobody's to replace; they may be named often.
void expect_distinct_files(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

}  // namespace shaolin
