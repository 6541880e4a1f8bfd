#pragma once
/// A progress bar for people: on stderr, and only if that is a terminal.
#include <atomic>
#include <cstddef>
#include <mutex>

namespace shaolin {

class Progress {
 public:
  /// `total` units of work lie ahead (at least 1).
  explicit Progress(std::size_t total);
  /// Wipes the bar.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// One unit is done. May be called from several threads at once.
  void advance();

 private:
  void draw(int percent);

  const std::size_t total_;
  const bool visible_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;
  int drawn_percent_ = -1;  ///< guarded by mutex_
};

}  // namespace shaolin
