#pragma once
/// Numbers of an option's value.
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "schemes/text.h"

namespace shaolin {

/// Reads exactly `count` finite numbers with commas between them.
template <std::size_t count>
std::optional<std::array<double, count>> parse_list(std::string_view text) {
  std::array<double, count> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == count)) return std::nullopt;
    const std::optional<double> number = to_number(text.substr(0, comma));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers[i] = *number;
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
  }
  return numbers;
}

}  // namespace shaolin
