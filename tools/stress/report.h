#pragma once
/// A run's figures for people and for scripts.
#include <filesystem>
#include <ostream>

#include "tools/bench/text_table.h"
#include "tools/stress/run.h"

namespace shaolin::stress {

/// One row per family and one for all: rays, hits, lost, ghosts, duplicates, undecided, the worst error in units of the
/// last place, the uncertified share ("-" where there are no hits), and how many of those are neither flat nor at a
/// boundary.
TextTable table_of(const Result& result);

/// The table, what makes the same run again, and the first failures of each row.
void print(std::ostream& out, const Result& result, std::uint64_t seed);

/// Writes, in a folder that it makes if it is not there:
///
/// - stress.csv: the rows by family and model;
/// - stress.json: the same, totals and failures;
/// - peers.csv: Peers::table(), if peers were asked;
/// - failures.csv: a row for each wrong answer: family, model, what was done to the model, fault, the ray in 17 digits,
///   what was found.
///
/// Throws InputError if that fails.
void write_report(const std::filesystem::path& folder, const Result& result, const RunOptions& options);

}  // namespace shaolin::stress
