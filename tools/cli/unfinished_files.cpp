#include "tools/cli/unfinished_files.h"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
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

constexpr std::array handled{SIGINT, SIGTERM, SIGHUP};

/// Calls only what signal handlers may call. A thread that changes a slot has the signals held back, so it is not this
/// one, and it is soon done.
void remove_all_and_end(int signal_number) {
  for (const Slot& slot : slots) {
    int state = slot.state.load();
    while (state == Slot::changing) state = slot.state.load();
    if (state == Slot::noted) unlink(slot.path.data());
  }
  ::signal(signal_number, SIG_DFL);
  raise(signal_number);
}

/// Holds the handled signals back from this thread.
class SignalsHeldBack {
 public:
  SignalsHeldBack() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int number : handled) sigaddset(&signals, number);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeldBack(const SignalsHeldBack&) = delete;
  SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

 private:
  sigset_t before_;
};

/// A slot for the path, in the state `changing`; null if all are taken or the path is too long for one.
Slot* take_slot(const std::string& path) {
  for (Slot& slot : slots) {
    int expected = Slot::empty;
    if (path.size() >= slot.path.size() || !slot.state.compare_exchange_strong(expected, Slot::changing)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
    return &slot;
  }
  return nullptr;
}

}  // namespace

void remove_unfinished_files_when_stopped() {
  for (const int number : handled) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = remove_all_and_end;
    sigaction(number, &action, nullptr);
  }
}

bool create_unfinished_file(const std::string& path) {
  const SignalsHeldBack held_back;
  Slot* const slot = take_slot(path);
  // "x" creates the file or fails, in one step.
  std::FILE* const file = std::fopen(path.c_str(), "wx");
  const int why = errno;
  if (slot != nullptr) slot->state = file != nullptr ? Slot::noted : Slot::empty;
  if (file != nullptr) std::fclose(file);
  errno = why;
  return file != nullptr;
}

void forget_unfinished_file(const std::string& path) {
  for (Slot& slot : slots)
    if (slot.state == Slot::noted && path == slot.path.data()) slot.state = Slot::empty;
}

}  // namespace shaolin
