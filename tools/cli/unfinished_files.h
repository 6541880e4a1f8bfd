#pragma once
/// Files that vanish if the program is stopped before they are finished.
#include <string>

namespace shaolin {

/// From now on SIGINT, SIGTERM and SIGHUP remove the noted files before they end the process. Signals that whoever
/// started the process had ignored stay ignored.
void remove_unfinished_files_when_stopped();

/// Makes an empty file and notes it, in one step for any signal. False, with errno set, if that fails: EEXIST if the
/// path is taken. The first eight files at a time, with paths of up to 4095 bytes, are kept in mind: a signal handler
/// cannot allocate. Any thread may call.
bool create_unfinished_file(const std::string& path);

/// Forgets a noted file: it is finished, or gone.
void forget_unfinished_file(const std::string& path);

}  // namespace shaolin
