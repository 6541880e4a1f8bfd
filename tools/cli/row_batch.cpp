#include "tools/cli/row_batch.h"

namespace shaolin {

void check_header(const CsvTable& table, const std::string& file, std::string_view names) {
  if (table.header().empty()) return;
  std::string found;
  for (const std::string& name : table.header()) found += name + ',';
  if (!(std::string(names) + ',').starts_with(found)) {
    found.pop_back();
    throw InputError("the header is '" + found + "', expected '" + std::string(names) + "' or none", file,
                     table.header_line());
  }
}

}  // namespace shaolin
