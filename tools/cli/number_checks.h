#pragma once
/// What numbers on the command line may be. CLI11's own checks let NaN pass and spell out bounds of 300 digits.
#include <CLI/CLI.hpp>

namespace shaolin {

/// Accept finite numbers above 0, and from 0 on.
CLI::Validator is_positive();
CLI::Validator is_not_negative();

}  // namespace shaolin
