#pragma once
/// `shaolin stress`: rays of the kinds that are lost most easily, at models and at meshes made by code.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command.h"

namespace shaolin {

struct StressOptions {
  std::vector<std::filesystem::path> models;  ///< MODEL...; none: small models made by code
  std::vector<std::string> families;          ///< --family; none: all
  std::size_t rays = 256;                     ///< --rays: of each family at each model
  double minutes = 0;                         ///< --minutes, in place of rays
  std::uint64_t seed = 1;                     ///< --seed
  std::optional<int> peers_level;             ///< --peers: that peers are built at; empty: they are not asked
  std::filesystem::path report;               ///< --report, a folder; empty: none
  int threads = 2;                            ///< --threads
};

/// Prints a table by families and writes the report. Returns exit_check_failed if a hit was lost, made up or reported
/// twice, else exit_done. Throws InputError for bad input. The same options give the same table; with `minutes` it ends
/// with the number of rays that does.
int stress_models(const StressOptions& options);

/// Registers the subcommand.
void add_stress(CLI::App& app, Command& command);

}  // namespace shaolin
