#include "tools/cli/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "schemes/errors.h"
#include "tools/cli/unfinished_files.h"

namespace shaolin {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& name, const std::string& why) {
  throw InputError("cannot be written: " + why, name.string());
}

/// Makes an empty file beside the target under a name that no other process has.
fs::path make_temporary(const fs::path& target, const fs::path& name) {
  constexpr int attempts = 10000;
  for (int i = 0; i < attempts; ++i) {
    fs::path candidate = target.parent_path() / target.stem();
    candidate += ".partial-" + std::to_string(i);
    candidate += target.extension();
    if (create_unfinished_file(candidate)) return candidate;
    if (errno != EEXIST) fail(name, std::generic_category().message(errno));
  }
  fail(name, "too many unfinished '.partial' files beside it");
}

}  // namespace

OutputFile::OutputFile(fs::path target) : name_(std::move(target)), target_(name_) {
  if (!name_.has_filename()) fail(name_, "expected the name of a file");
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::is_directory(status)) fail(name_, "it is a folder, expected a file");
  if (fs::exists(status)) {
    if (::access(target_.c_str(), W_OK) != 0) fail(name_, std::generic_category().message(errno));
    if (!fs::is_regular_file(status)) {
      temporary_ = target_;
      return;
    }
    target_ = fs::canonical(target_, error);
    if (error) fail(name_, error.message());
  } else if (const fs::path folder = target_.parent_path(); !folder.empty() && !fs::is_directory(folder, error)) {
    fail(name_, "the folder '" + folder.string() + "' does not exist");
  }
  temporary_ = make_temporary(target_, name_);
  // What replaces a file is no more public than the file was.
  if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

OutputFile::~OutputFile() {
  if (temporary_ == target_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
  forget_unfinished_file(temporary_);
}

void OutputFile::commit() {
  if (temporary_ == target_) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(name_, error.message());
  forget_unfinished_file(temporary_);
  temporary_ = target_;
}

}  // namespace shaolin
