#pragma once
/// Numbers on the command line, and what they may be. CLI11's own checks let NaN pass and spell out bounds of 300
/// digits.
#include <CLI/CLI.hpp>
#include <cstdint>

namespace shaolin {

/// Accept finite numbers above 0, and from 0 on.
CLI::Validator is_positive();
CLI::Validator is_not_negative();

/// Adds --seed N, of random numbers.
void add_seed_option(CLI::App& app, std::uint64_t& seed);

}  // namespace shaolin
