// CSV files of rays: whatever the bytes, rows of the right length or an InputError.
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "schemes/errors.h"
#include "tools/cli/csv.h"
#include "tools/cli/row_batch.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const shaolin::CsvTable table = shaolin::read_csv(file, "fuzzed", {6, 8});
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      const std::size_t columns = table.row(row).size();
      if ((columns != 6 && columns != 8) || table.line(row) < 1) std::abort();
    }
    check_header(table, "fuzzed", "ox,oy,oz,dx,dy,dz,tmin,tmax");
  } catch (const shaolin::InputError&) {
  }
  return 0;
}
