#pragma once
/// A bounding volume hierarchy over boxes, four children a node, one primitive a leaf.
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
  const Box& bounds() const { return bounds_; }

 private:
  /// Four boxes and what stands in them: a node, ~primitive, or nothing (the empty box).
  struct Node {
    FourBoxes boxes;
    std::array<std::int32_t, 4> child{};
  };
  struct Builder;

  std::vector<Node> nodes_;
  Box bounds_;
  int depth_ = 0;
};

template <class Far, class Visit>
void Bvh::traverse(const TraversalRay& ray, Far far, Visit visit) const {
  struct Entry {
    std::int32_t child;
    double distance;
  };
  if (nodes_.empty()) return;
  // Every level leaves at most three entries behind.
  constexpr int usual = 128;
  std::array<Entry, usual> fixed;
  std::vector<Entry> large;
  Entry* stack = fixed.data();
  if (3 * depth_ + 4 > usual) {
    large.resize(static_cast<std::size_t>(3 * depth_ + 4));
    stack = large.data();
  }
  int size = 0;
  stack[size++] = {0, -std::numeric_limits<double>::infinity()};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance > far()) continue;
    if (entry.child < 0) {
      if (visit(~entry.child, entry.distance)) return;
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(entry.child)];
    const BoxOrder order(node.boxes, ray, far());
    for (int i = order.count() - 1; i >= 0; --i) stack[size++] = {node.child[order.box(i)], order.distance(i)};
  }
}

}  // namespace shaolin
