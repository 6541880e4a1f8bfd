#include "tools/bench/text_table.h"

#include <algorithm>

#include "tools/cli/html.h"

namespace shaolin {

void write_html(std::ostream& out, const TextTable& table) {
  const auto write_row = [&](const std::vector<std::string>& cells, const std::string& tag) {
    out << "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      out << '<' << tag << (i < table.words ? ">" : " class=n>") << html_escaped(cells[i]);
    out << "</tr>\n";
  };
  out << "<table>";
  write_row(table.header, "th");
  for (const auto& row : table.rows) write_row(row, "td");
  out << "</table>\n";
}

void write_markdown(std::ostream& out, const TextTable& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.header.size(); ++i) {
    std::size_t width = std::max(table.header[i].size(), std::size_t{3});
    for (const auto& row : table.rows) width = std::max(width, row[i].size());
    widths.push_back(width);
  }
  const auto write_row = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      out << "| " << cells[i] << std::string(widths[i] - cells[i].size() + 1, ' ');
    out << "|\n";
  };
  write_row(table.header);
  for (std::size_t i = 0; i < widths.size(); ++i)
    out << (i < table.words ? "|:" + std::string(widths[i] + 1, '-') : "|" + std::string(widths[i] + 1, '-') + ":");
  out << "|\n";
  for (const auto& row : table.rows) write_row(row);
}

}  // namespace shaolin
