#pragma once
/// What a search has still to look at, the nearest first.
#include <algorithm>
#include <vector>

namespace shaolin {

/// Things by lower bounds of their distances. In which order those at equal distance come depends on the sequence of
/// calls alone.
template <class Thing>
class NearestQueue {
 public:
  NearestQueue() { heap_.reserve(64); }

  bool empty() const { return heap_.empty(); }
  /// Of the next to come.
  float distance() const { return heap_.front().distance; }

  void push(float distance, const Thing& thing) {
    heap_.push_back({distance, thing});
    std::push_heap(heap_.begin(), heap_.end(), is_farther);
  }
  Thing pop() {
    std::pop_heap(heap_.begin(), heap_.end(), is_farther);
    const Thing next = heap_.back().thing;
    heap_.pop_back();
    return next;
  }

 private:
  struct Entry {
    float distance;
    Thing thing;
  };
  static bool is_farther(const Entry& a, const Entry& b) { return a.distance > b.distance; }

  std::vector<Entry> heap_;
};

}  // namespace shaolin
