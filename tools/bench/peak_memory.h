#pragma once
/// The most memory that a piece of work holds at a time.
#include <cstddef>

namespace shaolin {

/// Measures the process's resident memory from its construction on. Memory that was freed before goes back to the
/// system first, so that work which takes it again is seen to. One at a time.
class PeakMemory {
 public:
  PeakMemory();

  /// By how many bytes the peak since then exceeds what was resident then; 0 where the system does not tell. The
  /// system counts pages in batches, so this is off by some hundred kilobytes (proc(5), VmRSS).
  std::size_t growth() const;

 private:
  std::size_t before_;
};

}  // namespace shaolin
