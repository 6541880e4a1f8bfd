#pragma once
/// Epoch-based reclamation: when something that readers were cut off from can be freed, because none of them can still
/// be in it. Readers pay a store at either end and wait for nobody.
#include <cstdint>

namespace shaolin {

/// While there is one, nothing is freed that this thread may have found. One for the process: a reader announces itself
/// to all who unlink. Guards may be nested; what is nested does nothing.
class EpochGuard {
 public:
  EpochGuard();
  ~EpochGuard();
  EpochGuard(const EpochGuard&) = delete;
  EpochGuard& operator=(const EpochGuard&) = delete;

  /// False: at its end the thread still reads.
  bool is_outermost() const { return is_outermost_; }

 private:
  bool is_outermost_;
};

/// Ends the current epoch and returns its number. Who begins to read in a later one does not find what was unlinked
/// before this call.
std::uint64_t end_epoch();

/// The earliest epoch in which a reader that is not done yet began; above all that have ended if there is none. What
/// was unlinked before end_epoch() gave a number below this can be freed. O(threads that ever read at the same time).
std::uint64_t oldest_epoch();

}  // namespace shaolin
