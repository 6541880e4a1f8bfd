#pragma once
/// A bounding volume hierarchy over boxes, one primitive a leaf.
#include <cstdint>
#include <vector>

#include "box.h"

namespace shaolin {

class Bvh {
 public:
  Bvh() = default;
  /// Surface-area heuristic over 16 bins of centroids (Wald 2007). Deterministic. O(n log n).
  explicit Bvh(const std::vector<Box>& boxes);

  /// Calls visit(primitive, entry distance) for the primitives whose boxes the ray meets before `far()`, nearest box
  /// first within each node; `far()` may shrink meanwhile. Stops when visit returns true.
  template <class Far, class Visit>
  void traverse(const TraversalRay& ray, Far far, Visit visit) const;

  std::size_t bytes() const { return nodes_.size() * sizeof(Node); }
  Box bounds() const { return nodes_.empty() ? Box() : nodes_.front().box; }

 private:
  /// An inner node's children stand at `first` and `first` + 1; a leaf has ~primitive in `first`.
  struct Node {
    Box box;
    std::int32_t first;
  };
  struct Builder;

  std::vector<Node> nodes_;
  int depth_ = 0;
};

template <class Far, class Visit>
void Bvh::traverse(const TraversalRay& ray, Far far, Visit visit) const {
  struct Entry {
    std::int32_t node;
    double distance;
  };
  if (nodes_.empty()) return;
  Entry fixed[64];
  std::vector<Entry> large;
  Entry* stack = fixed;
  if (depth_ + 2 > 64) {
    large.resize(static_cast<std::size_t>(depth_) + 2);
    stack = large.data();
  }
  int size = 0;
  if (const double root = entry_distance(nodes_[0].box, ray, far()); root < missed) stack[size++] = {0, root};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance > far()) continue;
    const std::int32_t first = nodes_[static_cast<std::size_t>(entry.node)].first;
    if (first < 0) {
      if (visit(~first, entry.distance)) return;
      continue;
    }
    const double a = entry_distance(nodes_[static_cast<std::size_t>(first)].box, ray, far());
    const double b = entry_distance(nodes_[static_cast<std::size_t>(first) + 1].box, ray, far());
    const bool a_first = a <= b;
    const Entry nearer{a_first ? first : first + 1, std::min(a, b)},
        farther{a_first ? first + 1 : first, std::max(a, b)};
    if (farther.distance < missed) stack[size++] = farther;
    if (nearer.distance < missed) stack[size++] = nearer;
  }
}

}  // namespace shaolin
