#pragma once
/// What the trees of patches of a scene add up to.
#include <atomic>
#include <cstdint>

namespace shaolin {

/// Sums over all trees of an object; see Statistics.
struct TreeTotals {
  std::atomic<std::uint64_t> bytes{0};
  std::atomic<std::uint64_t> patches_split{0};
  std::atomic<std::uint64_t> invalid_patches{0};
  std::atomic<std::uint64_t> unresolved_patches{0};

  void add(const TreeTotals& other) {
    bytes += other.bytes;
    patches_split += other.patches_split;
    invalid_patches += other.invalid_patches;
    unresolved_patches += other.unresolved_patches;
  }
};

}  // namespace shaolin
