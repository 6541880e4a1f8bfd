#include "tools/cli/json_text.h"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

#include "schemes/text.h"

namespace shaolin {
namespace {

/// A key or an index as a step of a JSON pointer.
std::string step(const std::string& key) {
  std::string text = "/";
  for (const char c : key) {
    if (c == '~')
      text += "~0";
    else if (c == '/')
      text += "~1";
    else
      text += c >= ' ' && c != '\x7f' ? c : '?';
  }
  return text;
}

/// Goes through the text once, for what the parser that builds the document does not say: where a number overflows,
/// and that a key stands twice.
class Checker : public nlohmann::json_sax<Json> {
 public:
  Checker(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  bool null() override { return element(); }
  bool boolean(bool) override { return element(); }
  bool number_integer(number_integer_t) override { return element(); }
  bool number_unsigned(number_unsigned_t) override { return element(); }
  bool number_float(number_float_t, const string_t&) override { return element(); }
  bool string(string_t&) override { return element(); }
  bool binary(binary_t&) override { return element(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second) throw InputError(path() + ": this key stands twice in its object", file_);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
    const std::size_t end = std::min(position > 0 ? position - 1 : 0, text_.size());
    const std::size_t line_start = text_.rfind('\n', end > 0 ? end - 1 : 0);
    const std::size_t column = end - (end > 0 && line_start != std::string::npos ? line_start + 1 : 0) + 1;
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw InputError("column " + std::to_string(column) + ": " + reason(error.what()), file_, static_cast<int>(line));
  }

 private:
  struct Level {
    bool is_array;
    std::size_t next = 0;  ///< of an array
    std::string key;       ///< of an object
    std::set<std::string> keys;
  };

  /// The library's message without its number and its own idea of the place.
  static std::string reason(const std::string& message) {
    for (const std::string mark : {"column ", "] "}) {
      const std::size_t at = message.find(mark);
      if (at == std::string::npos) continue;
      const std::size_t colon = mark == "] " ? at : message.find(": ", at);
      if (colon != std::string::npos) return message.substr(colon + 2);
    }
    return message;
  }

  bool element() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().next;
    return true;
  }
  bool open(bool is_array) {
    levels_.push_back({is_array, 0, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return element();
  }
  std::string path() const {
    std::string text;
    for (const Level& level : levels_) text += step(level.is_array ? std::to_string(level.next) : level.key);
    return text;
  }

  const std::string& file_;
  const std::string& text_;
  std::vector<Level> levels_;
};

std::string to_text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

}  // namespace

Json read_json(const std::filesystem::path& file) {
  const std::string name = file.string(), text = read_text_file(file);
  Checker checker(name, text);
  Json::sax_parse(text, &checker);
  return Json::parse(text);
}

void JsonNode::fail(const std::string& message) const { throw InputError(path() + ": " + message, *file_); }

std::string JsonNode::kind() const {
  if (value_->is_null()) return "null";
  const std::string name = value_->type_name();
  return (name.find_first_of("aeiou") == 0 ? "an " : "a ") + name;
}

JsonNode JsonNode::child(const Json& value, const std::string& key) const {
  return JsonNode(value, *file_, path_ + step(key));
}

void JsonNode::check_keys(std::initializer_list<const char*> known) const {
  for (const auto& [key, node] : members())
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string names;
      for (const char* const name : known) names += (names.empty() ? "" : ", ") + std::string(name);
      node.fail("unknown key; expected one of " + names);
    }
}

JsonNode JsonNode::at(const char* key) const {
  if (const std::optional<JsonNode> node = find(key)) return *node;
  fail("the key '" + std::string(key) + "' is missing");
}

std::optional<JsonNode> JsonNode::find(const char* key) const {
  if (!value_->is_object()) fail("is " + kind() + "; expected an object");
  const auto found = value_->find(key);
  return found == value_->end() ? std::nullopt : std::optional(child(*found, key));
}

std::vector<std::pair<std::string, JsonNode>> JsonNode::members() const {
  if (!value_->is_object()) fail("is " + kind() + "; expected an object");
  std::vector<std::pair<std::string, JsonNode>> nodes;
  for (const auto& [key, value] : value_->items()) nodes.emplace_back(key, child(value, key));
  return nodes;
}

std::vector<JsonNode> JsonNode::elements() const {
  if (!value_->is_array()) fail("is " + kind() + "; expected an array");
  std::vector<JsonNode> nodes;
  for (std::size_t i = 0; i < value_->size(); ++i) nodes.push_back(child((*value_)[i], std::to_string(i)));
  return nodes;
}

std::vector<JsonNode> JsonNode::elements(std::size_t count) const {
  const std::string expected = "expected an array of " + std::to_string(count);
  if (!value_->is_array()) fail("is " + kind() + "; " + expected);
  if (value_->size() != count) fail("has " + std::to_string(value_->size()) + " elements; " + expected);
  return elements();
}

double JsonNode::number() const {
  if (!value_->is_number()) fail("is " + kind() + "; expected a number");
  return value_->get<double>();
}

double JsonNode::number(double least, double most) const {
  const double value = number();
  if (value >= least && value <= most) return value;
  const bool bounded = most < std::numeric_limits<double>::infinity();
  fail("is " + to_text(value) + "; expected a number " +
       (bounded ? "from " + to_text(least) + " to " + to_text(most) : "of at least " + to_text(least)));
}

std::string JsonNode::text() const {
  if (!value_->is_string()) fail("is " + kind() + "; expected a string");
  return value_->get<std::string>();
}

Vec3 JsonNode::vector() const {
  const std::vector<JsonNode> numbers = elements(3);
  return {numbers[0].number(), numbers[1].number(), numbers[2].number()};
}

Vec3 JsonNode::vector(double least, double most) const {
  const std::vector<JsonNode> numbers = elements(3);
  return {numbers[0].number(least, most), numbers[1].number(least, most), numbers[2].number(least, most)};
}

}  // namespace shaolin
