#include "tests/allocation.h"

#include <cstdlib>
#include <limits>
#include <new>

namespace {

constexpr std::size_t never = std::numeric_limits<std::size_t>::max();
thread_local std::size_t until_failure = never;
thread_local bool has_failed = false;

/// True if this allocation is the one.
bool fails() {
  if (until_failure == never) return false;
  if (until_failure-- > 0) return false;
  until_failure = never;
  has_failed = true;
  return true;
}

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
// The linker's --wrap=malloc sends calls of malloc() here (Eigen's matrices).
void* __wrap_malloc(std::size_t size) { return fails() ? nullptr : __real_malloc(size); }
}

namespace {

void* allocate(std::size_t size) {
  if (!fails())
    if (void* const memory = __real_malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

void* allocate(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  if (!fails())
    if (void* const memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return allocate(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return fails() ? nullptr : __real_malloc(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return fails() ? nullptr : __real_malloc(size);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace shaolin {

FailingAllocation::FailingAllocation(std::size_t number) {
  until_failure = number;
  has_failed = false;
}
FailingAllocation::~FailingAllocation() { until_failure = never; }
bool FailingAllocation::failed() const { return has_failed; }

}  // namespace shaolin
