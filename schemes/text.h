#pragma once
/// Reading text: a file in one go, numbers by std::from_chars (exact rounding, no locale), words quoted for messages.
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "errors.h"

namespace shaolin {

namespace detail {

/// A number whose magnitude from_chars refuses: infinite if too large, denormal or zero if too small.
inline double out_of_range_number(std::string_view word) {
  std::istringstream stream{std::string(word)};
  stream.imbue(std::locale::classic());
  double value = 0;
  if (stream >> value) return value;
  return value < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

/// from_chars knows no leading '+', people do; "+-1" stays malformed.
inline std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace detail

/// The whole word as a decimal number ("1", "+.5", "1e-3", also "inf" and "nan"), or empty if it is anything else.
inline std::optional<double> to_number(std::string_view word) {
  word = detail::without_plus(word);
  double value = 0;
  const char* const last = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), last, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != last) return std::nullopt;
  return result.ec == std::errc() ? value : detail::out_of_range_number(word);
}

/// The whole word as an integer, or empty if it is anything else. What exceeds long long becomes its nearest value.
inline std::optional<long long> to_integer(std::string_view word) {
  word = detail::without_plus(word);
  long long value = 0;
  const char* const last = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), last, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != last) return std::nullopt;
  if (result.ec == std::errc()) return value;
  return word[0] == '-' ? std::numeric_limits<long long>::min() : std::numeric_limits<long long>::max();
}

/// The word in quotes, fit for a terminal: bytes that are not printable ASCII become '?', long words are cut.
inline std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

/// Everything that is left in the stream, without a leading UTF-8 byte order mark. Throws InputError if reading fails
/// or if there is a zero byte: that is no text file.
inline std::string read_text(std::istream& stream, const std::string& name) {
  constexpr std::size_t block = std::size_t{1} << 20;
  std::string text;
  std::size_t size = 0;
  while (stream) {
    text.resize(size + block);
    stream.read(text.data() + size, static_cast<std::streamsize>(block));
    size += static_cast<std::size_t>(stream.gcount());
  }
  text.resize(size);
  if (stream.bad() || !stream.eof()) throw InputError("cannot be read", name);
  if (text.find('\0') != std::string::npos) throw InputError("contains zero bytes, expected a text file", name);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

/// The whole text file. Throws InputError if it is missing, a directory, unreadable or binary.
inline std::string read_text_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) throw InputError("no such file", name);
  if (std::filesystem::is_directory(file, ignored)) throw InputError("is a directory, expected a file", name);
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError("cannot be opened for reading", name);
  return read_text(stream, name);
}

}  // namespace shaolin
