#pragma once
/// Output that appears whole or not at all.
#include <filesystem>

namespace shaolin {

/// A temporary file beside the target, with the target's extension (image libraries look at it), that takes the
/// target's place on commit(). Without commit() the destructor removes it and the target stays as it was; so does a
/// signal that ends the program (unfinished_files.h).
///
/// A target that exists and is no regular file (/dev/stdout, a pipe) is written directly, since it cannot be replaced.
class OutputFile {
 public:
  /// Makes the temporary file, empty. Throws InputError, naming the target, if its folder does not exist or cannot be
  /// written to, or if the target is a folder or write-protected.
  explicit OutputFile(std::filesystem::path target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The file to write to before commit().
  const std::filesystem::path& path() const { return temporary_; }

  /// Puts the temporary file in the target's place, at once; close it first. Throws InputError if that fails.
  void commit();

 private:
  std::filesystem::path name_;    ///< the target as the user gave it, for messages
  std::filesystem::path target_;  ///< with symbolic links resolved: the file is replaced, not the link
  std::filesystem::path temporary_;
};

}  // namespace shaolin
