#pragma once
/// Runs the tool as people do: the real binary, in a folder of its own, with its exit status and all that it prints.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/catch.h"

namespace shaolin::test {

/// An environment variable that the test suite sets; its absence is a failure, not a reason to skip.
inline std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  INFO("environment variable " << name);
  REQUIRE(value != nullptr);
  return value;
}

inline std::filesystem::path data_file(const std::string& name) {
  return std::filesystem::path(environment("SHAOLIN_DATA")) / name;
}

inline std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// A CSV file as the fields of its rows, the header included.
inline std::vector<std::vector<std::string>> read_rows(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) rows.push_back(split(line, ','));
  return rows;
}

/// What a run of the tool came to.
struct Outcome {
  int status;
  std::string text;  ///< stdout and stderr
};

/// A folder that is empty at first and vanishes at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "shaolin-test-XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
    log_ = pattern + ".log";
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    std::filesystem::remove(log_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// Writes a text file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

  std::set<std::string> list() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) names.insert(entry.path().filename());
    return names;
  }

  /// Runs the tool with these arguments.
  Outcome run(const std::vector<std::string>& arguments) const {
    std::string command = quoted(environment("SHAOLIN_BINARY"));
    for (const std::string& argument : arguments) command += ' ' + quoted(argument);
    const int status = std::system((command + " >" + quoted(log_) + " 2>&1").c_str());
    REQUIRE(WIFEXITED(status));  // anything else is a crash
    return {WEXITSTATUS(status), read_file(log_)};
  }

 private:
  static std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
  }

  std::filesystem::path path_;
  std::string log_;
};

}  // namespace shaolin::test
