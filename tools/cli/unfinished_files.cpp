#include "tools/cli/unfinished_files.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>

namespace shaolin {

namespace {

struct Slot {
  enum State : int { empty, changing, noted };
  std::atomic<int> state{empty};
  std::array<char, 4096> path{};
};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads it");

std::array<Slot, 8> slots;

/// Calls only what signal handlers may call.
void remove_all_and_end(int signal_number) {
  for (const Slot& slot : slots)
    if (slot.state.load() == Slot::noted) unlink(slot.path.data());
  ::signal(signal_number, SIG_DFL);
  raise(signal_number);
}

}  // namespace

void remove_unfinished_files_when_stopped() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remove_all_and_end;
    sigaction(number, &action, nullptr);
  }
}

void note_unfinished_file(const std::string& path) {
  for (Slot& slot : slots) {
    int expected = Slot::empty;
    if (path.size() >= slot.path.size() || !slot.state.compare_exchange_strong(expected, Slot::changing)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
    slot.state = Slot::noted;
    return;
  }
}

void forget_unfinished_file(const std::string& path) {
  for (Slot& slot : slots)
    if (slot.state == Slot::noted && path == slot.path.data()) slot.state = Slot::empty;
}

}  // namespace shaolin
