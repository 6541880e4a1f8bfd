#pragma once
/// Time of one thread's work.
#include <ctime>

namespace shaolin {

/// Seconds of processor time that the calling thread took between laps. While the system lets others run in its place
/// it stands still: on a busy machine a time slice of theirs is as long as many thousand rays. What other threads do
/// for this one does not count. Steps are of some nanoseconds.
class ThreadStopwatch {
 public:
  /// Seconds since the last lap or the construction.
  double lap() {
    const double now = read(), elapsed = now - last_;
    last_ = now;
    return elapsed;
  }

 private:
  static double read() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double last_ = read();
};

}  // namespace shaolin
