#pragma once
/// Work in a process of its own, so that its peak memory is its own and nothing is warm from the run before.
#include <sys/mman.h>

#include <cstddef>
#include <functional>
#include <new>
#include <span>
#include <type_traits>

namespace shaolin {

/// Runs `work` in a forked child and waits for it. Returns the child's peak resident memory in bytes. Throws
/// std::runtime_error if the child does not end well; what went wrong in it stands on stderr. The caller must not have
/// started threads.
std::size_t run_in_child(const std::function<void()>& work);

/// `count` values that a child writes and its parent reads.
template <typename T>
requires std::is_trivially_destructible_v<T>
class SharedArray {
 public:
  explicit SharedArray(std::size_t count) : bytes_(count * sizeof(T)), count_(count) {
    void* const memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    values_ = static_cast<T*>(memory);
    for (std::size_t i = 0; i < count; ++i) new (values_ + i) T();
  }
  ~SharedArray() { munmap(values_, bytes_); }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;

  std::span<T> values() const { return {values_, count_}; }

 private:
  std::size_t bytes_;
  std::size_t count_;
  T* values_ = nullptr;
};

}  // namespace shaolin
