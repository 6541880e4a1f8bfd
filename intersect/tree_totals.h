#pragma once
/// What the trees of patches of a scene add up to.
#include <atomic>
#include <cstdint>

namespace shaolin {

/// Bytes that are held, and a share of an account with others, if there is one, that lives longer. Thread-safe.
class ByteCount {
 public:
  explicit ByteCount(std::atomic<std::uint64_t>* account = nullptr) : account_(account) {}
  ~ByteCount() { *this -= own_; }
  ByteCount(const ByteCount&) = delete;
  ByteCount& operator=(const ByteCount&) = delete;

  operator std::uint64_t() const { return own_; }
  ByteCount& operator+=(std::uint64_t bytes) {
    own_ += bytes;
    if (account_) *account_ += bytes;
    return *this;
  }
  ByteCount& operator-=(std::uint64_t bytes) {
    own_ -= bytes;
    if (account_) *account_ -= bytes;
    return *this;
  }

 private:
  std::atomic<std::uint64_t> own_{0};
  std::atomic<std::uint64_t>* account_;
};

/// Sums over all trees of an object; see Statistics.
struct TreeTotals {
  ByteCount bytes;
  std::atomic<std::uint64_t> patches_split{0};
  std::atomic<std::uint64_t> invalid_patches{0};
  std::atomic<std::uint64_t> unresolved_patches{0};
};

}  // namespace shaolin
