#pragma once
/// `shaolin validate`: the model's surface and hits, held against an oracle.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "tools/cli/command.h"
#include "tools/cli/model.h"

namespace shaolin {

struct ValidateOptions {
  ModelOptions model;
  std::optional<std::size_t> rays;         ///< --rays; a tenth of that in addition is aimed at edges and vertices
  std::optional<std::size_t> evaluations;  ///< --evaluations
  std::size_t exact = 0;                   ///< --exact: so many rays
  std::uint64_t seed = 1;                  ///< --seed
  std::filesystem::path report;            ///< --report; empty: none
  int threads = 0;                         ///< --threads; 0: all
};

/// Prints the table of figures, bars and verdicts to stdout and writes the report. Returns exit_done if every bar is
/// met, else exit_check_failed. Throws InputError for bad input. The same options give the same figures.
int validate(const ValidateOptions& options);

/// Registers the subcommand.
void add_validate(CLI::App& app, Command& command);

}  // namespace shaolin
