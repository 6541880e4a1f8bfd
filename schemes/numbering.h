#pragma once
/// Names numbered in the order in which they are met.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace shaolin {

/// Names of so many words, each with a number counted from 0. For the tens to hundreds of names of a neighbourhood: an
/// open-addressed table that is half full at most, and from which nothing is taken.
template <std::size_t words>
class Numbering {
 public:
  using Name = std::array<int, words>;

  Numbering() : table_(initial_slots, none) { names_.reserve(initial_slots / 2); }

  /// The number of a name; what is met for the first time has size() as it was. Amortised O(1).
  int operator()(const Name& name) {
    std::size_t slot = slot_of(name);
    if (table_[slot] != none) return table_[slot];
    if (2 * (names_.size() + 1) > table_.size()) {
      grow();
      slot = slot_of(name);
    }
    names_.push_back(name);
    return table_[slot] = size() - 1;
  }

  int size() const { return static_cast<int>(names_.size()); }
  /// By number.
  const std::vector<Name>& names() const { return names_; }

 private:
  static constexpr std::size_t initial_slots = 128;
  static constexpr int none = -1;

  /// Where the name stands, or the free slot for it. (Multiplicative hashing; the upper half of a product has mixed all
  /// bits below.)
  std::size_t slot_of(const Name& name) const {
    std::uint64_t hash = 0;
    for (const int word : name) {
      hash = (hash + static_cast<std::uint32_t>(word)) * 0x9e3779b97f4a7c15;
      hash ^= hash >> 32;
    }
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = hash & mask;
    while (table_[slot] != none && !is_equal(names_[static_cast<std::size_t>(table_[slot])], name))
      slot = (slot + 1) & mask;
    return slot;
  }

  /// (Of so few words the library's comparison would be a call.)
  static bool is_equal(const Name& a, const Name& b) {
    for (std::size_t i = 0; i < words; ++i)
      if (a[i] != b[i]) return false;
    return true;
  }

  void grow() {
    table_.assign(2 * table_.size(), none);
    for (int number = 0; number < size(); ++number) table_[slot_of(names_[static_cast<std::size_t>(number)])] = number;
  }

  std::vector<Name> names_;
  std::vector<int> table_;  ///< numbers
};

}  // namespace shaolin
