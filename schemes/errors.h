#pragma once
/// The typed exceptions that cross the library's boundary.
#include <stdexcept>
#include <string>

namespace shaolin {

/// Input that cannot be used: what is wrong, where it stands and what was expected.
/// `what()` reads "file:line: message" (or "file: message", or the message alone, as far as the place is known).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message, std::string file = {}, int line = 0)
      : std::runtime_error(located(message, file, line)), file_(std::move(file)), line_(line) {}

  const std::string& file() const { return file_; }
  int line() const { return line_; }  ///< counts from 1; 0 where no line is known

 private:
  static std::string located(const std::string& message, const std::string& file, int line) {
    if (file.empty()) return message;
    return file + (line > 0 ? ':' + std::to_string(line) : std::string()) + ": " + message;
  }

  std::string file_;
  int line_;
};

}  // namespace shaolin
