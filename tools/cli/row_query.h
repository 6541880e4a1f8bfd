#pragma once
/// What subcommands have in common that answer rows of questions to a scene with rows of places.
#include <optional>
#include <string>

#include "tools/cli/csv_place.h"
#include "tools/cli/row_batch.h"
#include "tools/cli/row_input.h"
#include "tools/cli/stage.h"

namespace shaolin {

/// Writes a row per question: its number, 1 or 0, and with an answer `write_answer(writer, answer)`, whose fields are
/// empty else; last the instance, for scene files. `columns` names the fields between, "a,b,c".
template <class Ask, class WriteAnswer>
void answer_rows(const CsvTable& table, const std::filesystem::path& output, const std::string& first,
                 const std::string& columns, bool instances, Ask ask, WriteAnswer write_answer) {
  CsvWriter writer(output, first + "," + columns + (instances ? ",instance" : ""));
  const int fields = static_cast<int>(std::count(columns.begin(), columns.end(), ',')) + instances;
  process_rows(
      table, [&](std::size_t row) { return ask(table.row(row)); },
      [&](std::size_t row, const auto& answer) {
        writer.field(static_cast<long long>(row)).field(answer ? 1 : 0);
        if (answer) {
          write_answer(writer, *answer);
          if (instances) writer.field(answer->instance);
        } else {
          writer.empty(fields);
        }
        writer.end_row();
      });
  writer.commit();
}

/// Help for the column that scenes have in addition.
inline constexpr const char* instance_column =
    "Of scenes with one more column, instance, which counts from 0 in the file's order with groups dissolved";

}  // namespace shaolin
