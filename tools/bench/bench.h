#pragma once
/// `shaolin bench`: the paper's measurements, time against error, and the search for lost hits.
#include <CLI/CLI.hpp>

#include "tools/cli/command.h"

namespace shaolin {

/// Registers the subcommand with `paper`, `pareto` and `lost`.
void add_bench(CLI::App& app, Command& command);

}  // namespace shaolin
