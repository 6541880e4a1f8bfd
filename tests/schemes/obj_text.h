#pragma once
// Meshes given as OBJ text, and the messages that malformed text ends with.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "schemes/errors.h"
#include "schemes/obj.h"
#include "tests/catch.h"

namespace shaolin::obj_text {

inline const std::string tetrahedron =
    "v 0 0 0\n"
    "v 1 0 0\n"
    "v 0 1 0\n"
    "v 0 0 1\n"
    "f 1 3 2\n"
    "f 1 2 4\n"
    "f 1 4 3\n"
    "f 2 3 4\n";

inline ControlMesh parse(const std::string& text) {
  std::istringstream stream(text);
  return read_obj(stream, "m.obj");
}

/// The message that reading the text ends with.
inline std::string message_of(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    CHECK(error.file() == "m.obj");
    return error.what();
  }
  return "(no error)";
}

/// The message that reading the file ends with.
inline std::string message_of_file(const std::filesystem::path& file) {
  try {
    read_obj(file);
  } catch (const InputError& error) {
    CHECK(error.file() == file.string());
    return error.what();
  }
  return "(no error)";
}

inline void check_contains(const std::string& text, const std::string& part) {
  CAPTURE(text, part);
  CHECK(text.find(part) != std::string::npos);
}

inline void check_starts(const std::string& text, const std::string& start) {
  CAPTURE(text, start);
  CHECK(text.starts_with(start));
}

/// The text is an error at that line, and the message has all these words.
inline void check_error(const std::string& text, int line, const std::vector<std::string>& words) {
  const std::string message = message_of(text);
  INFO(text.substr(0, 400));
  CAPTURE(message);
  CHECK(message.starts_with("m.obj:" + std::to_string(line) + ": "));
  for (const std::string& word : words) CHECK(message.find(word) != std::string::npos);
}

/// The same for a line after the eight of the tetrahedron.
inline void check_tag_error(const std::string& tag, const std::vector<std::string>& words) {
  check_error(tetrahedron + tag + "\n", 9, words);
}

}  // namespace shaolin::obj_text
