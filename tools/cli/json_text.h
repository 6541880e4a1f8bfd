#pragma once
/// JSON from files, with messages for people: what is wrong, where, and what was expected.
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "schemes/vec3.h"

namespace shaolin {

using Json = nlohmann::ordered_json;

/// Reads a file of strict JSON (RFC 8259: no comments). Throws InputError with line and column for a syntax error and a
/// number that exceeds doubles, with the JSON path for a key that stands twice in one object.
Json read_json(const std::filesystem::path& file);

/// A value in a JSON document and its place there: what a reader asks, and complains about. All functions that return a
/// value throw InputError "FILE: PATH: message" if it is of another kind; paths are JSON pointers (RFC 6901), the whole
/// document's is "/". It refers to the document and to the file's name, which must outlive it.
class JsonNode {
 public:
  JsonNode(const Json& document, const std::string& file) : JsonNode(document, file, {}) {}

  [[noreturn]] void fail(const std::string& message) const;
  const std::string& file() const { return *file_; }
  std::string path() const { return path_.empty() ? "/" : path_; }

  /// Fails unless this is an object with no keys but these.
  void check_keys(std::initializer_list<const char*> known) const;
  bool has(const char* key) const { return value_->is_object() && value_->contains(key); }
  JsonNode at(const char* key) const;                   ///< of an object that must have it
  std::optional<JsonNode> find(const char* key) const;  ///< of an object that may have it

  std::vector<std::pair<std::string, JsonNode>> members() const;  ///< of an object, in the file's order
  std::vector<JsonNode> elements() const;                         ///< of an array
  std::vector<JsonNode> elements(std::size_t count) const;        ///< of an array of that length

  bool is_number() const { return value_->is_number(); }
  bool is_array() const { return value_->is_array(); }
  double number() const;
  double number(double least, double most) const;  ///< within these bounds
  std::string text() const;
  Vec3 vector() const;                           ///< an array of three numbers
  Vec3 vector(double least, double most) const;  ///< of three within these bounds

 private:
  JsonNode(const Json& value, const std::string& file, std::string path)
      : value_(&value), file_(&file), path_(std::move(path)) {}
  JsonNode child(const Json& value, const std::string& key) const;
  std::string kind() const;

  const Json* value_;
  const std::string* file_;
  std::string path_;
};

}  // namespace shaolin
