#pragma once
/// Work on the rows of a table: computed in parallel, written in order.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "schemes/errors.h"
#include "tools/cli/csv.h"

namespace shaolin {

/// Calls compute(row) for all rows, on all of the current arena's threads, and write(row, result) for one row after the
/// other. An InputError from compute() is thrown again with the row's file and line; of several, the first row's. Holds
/// the results of a block of rows only.
template <typename Compute, typename Write>
void process_rows(const CsvTable& table, const Compute& compute, const Write& write) {
  constexpr std::size_t block_size = 1 << 16;
  using Result = std::invoke_result_t<Compute, std::size_t>;
  std::vector<Result> results;
  std::vector<std::string> errors;
  for (std::size_t begin = 0; begin < table.row_count(); begin += block_size) {
    const std::size_t count = std::min(block_size, table.row_count() - begin);
    results.assign(count, Result{});
    errors.assign(count, std::string());
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      try {
        results[i] = compute(begin + i);
      } catch (const InputError& error) {
        errors[i] = error.what();
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!errors[i].empty()) table.fail(begin + i, errors[i]);
      write(begin + i, results[i]);
    }
  }
}

/// Throws InputError if the table has a header and its names do not begin those in `names` ("a,b,c"), in this order: a
/// file with other or reordered columns would be misread.
void check_header(const CsvTable& table, const std::string& file, std::string_view names);

}  // namespace shaolin
