#pragma once
/// What a subcommand gives to main(): the work to do, and the process's exit status.
#include <functional>

namespace shaolin {

/// The exit statuses of the tool: a contract with scripts.
enum ExitStatus {
  exit_done = 0,          ///< everything was done
  exit_check_failed = 1,  ///< the tool ran, and what it checked is wrong
  exit_usage = 2,         ///< unknown option, missing argument, malformed value
  exit_bad_input = 3      ///< a file that cannot be read, used or written
};

/// The work of the subcommand that the user chose; returns an ExitStatus. A subcommand's `add_...` function registers
/// its options with the parser and sets this when the subcommand is met; main() runs it after parsing.
using Command = std::function<int()>;

}  // namespace shaolin
