#pragma once
/// Options whose values have a parser of ours.
#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

namespace shaolin {

/// Makes a parser's complaint a usage error.
template <typename Value, typename Parse>
std::function<void(const std::string&)> parse_into(Value& value, Parse parse, const char* flag) {
  return [&value, parse, flag](const std::string& text) {
    try {
      value = parse(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(flag, error.what());
    }
  };
}

}  // namespace shaolin
