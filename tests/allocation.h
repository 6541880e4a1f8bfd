#pragma once
// Memory that runs out when a test says so.
#include <cstddef>

namespace shaolin {

/// While one lives, this thread's allocation number `number` (from 0) fails: operator new throws std::bad_alloc, malloc()
/// gives null. Those before and after succeed. Covers what is compiled into the test program: the library, Eigen, the
/// standard library's templates.
class FailingAllocation {
 public:
  explicit FailingAllocation(std::size_t number);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;

  /// True once it has failed.
  bool failed() const;
};

}  // namespace shaolin
