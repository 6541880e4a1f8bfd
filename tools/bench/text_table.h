#pragma once
/// A table of words and numbers, for pages and terminals.
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

namespace shaolin {

struct TextTable {
  std::vector<std::string> header{};
  std::vector<std::vector<std::string>> rows{};  ///< each as long as the header
  std::size_t words = 1;                         ///< so many columns at the left hold words, the others numbers
};

void write_html(std::ostream& out, const TextTable& table);

/// As Markdown, with columns that stand below each other.
void write_markdown(std::ostream& out, const TextTable& table);

}  // namespace shaolin
