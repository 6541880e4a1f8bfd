#include "bvh.h"

#include <array>
#include <numeric>

namespace shaolin {

struct Bvh::Builder {
  static constexpr int bin_count = 16;

  /// A node of the binary hierarchy that is built first: children at `first` and `first` + 1, or ~primitive.
  struct Binary {
    Box box;
    std::int32_t first;
  };

  const std::vector<Box>& boxes;
  std::vector<Vec3> centres;
  std::vector<std::int32_t> order;
  std::vector<Binary> nodes;

  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  struct Task {
    std::size_t node;
    Range range;
  };

  void build() {
    nodes.reserve(2 * boxes.size());
    nodes.push_back({});
    std::vector<Task> tasks{{0, {0, boxes.size()}}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      Binary node;
      for (std::size_t i = task.range.begin; i < task.range.end; ++i) node.box.add(boxes[at(order[i])]);
      if (task.range.size() == 1) {
        node.first = ~order[task.range.begin];
      } else {
        const std::size_t middle = split(task.range);
        const std::size_t first = nodes.size();
        node.first = static_cast<std::int32_t>(first);
        nodes.resize(first + 2);
        tasks.push_back({first, {task.range.begin, middle}});
        tasks.push_back({first + 1, {middle, task.range.end}});
      }
      nodes[task.node] = node;
    }
  }

  /// The two children of a binary node, then the largest inner one of them replaced by its own two until there are
  /// as many as a wide node holds.
  std::vector<std::int32_t> wide_children(std::int32_t node) const {
    std::vector<std::int32_t> children{node};
    while (children.size() < width) {
      double largest = -1;
      std::size_t open = children.size();
      for (std::size_t i = 0; i < children.size(); ++i) {
        const Binary& child = nodes[at(children[i])];
        if (child.first < 0 || child.box.half_area() <= largest) continue;
        largest = child.box.half_area();
        open = i;
      }
      if (open == children.size()) break;
      const std::int32_t first = nodes[at(children[open])].first;
      children[open] = first;
      children.push_back(first + 1);
    }
    return children;
  }

  /// Collapses the binary hierarchy; returns the depth.
  int collapse(std::vector<Node>& wide, const BoxSpace& space) const {
    struct Open {
      std::int32_t binary;
      std::size_t wide;
      int depth;
    };
    int depth = 0;
    wide.emplace_back();
    std::vector<Open> tasks{{0, 0, 1}};
    while (!tasks.empty()) {
      const Open task = tasks.back();
      tasks.pop_back();
      depth = std::max(depth, task.depth);
      const std::vector<std::int32_t> children = wide_children(task.binary);
      for (std::size_t i = 0; i < children.size(); ++i) {
        const Binary& child = nodes[at(children[i])];
        std::int32_t target = child.first;
        if (target >= 0) {
          target = static_cast<std::int32_t>(wide.size());
          wide.emplace_back();
          tasks.push_back({children[i], at(target), task.depth + 1});
        }
        wide[task.wide].boxes.set(i, {child.box, space});
        wide[task.wide].child[i] = target;
      }
    }
    return depth;
  }

  static std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

  /// Where to cut the range, after reordering it: the cheapest of the bins' borders on the longest axis of the centres,
  /// or the middle if all centres fall into one bin.
  std::size_t split(Range range) {
    Box extent;
    for (std::size_t i = range.begin; i < range.end; ++i) extent.add(centres[at(order[i])]);
    int axis;
    const double length = (extent.upper - extent.lower).maxCoeff(&axis);
    const std::size_t middle = range.begin + range.size() / 2;
    if (!(length > 0) || !std::isfinite(length)) return middle;

    const double scale = bin_count / length;
    const auto bin_of = [&](std::int32_t primitive) {
      const double bin = (centres[at(primitive)][axis] - extent.lower[axis]) * scale;
      return std::min(bin_count - 1, static_cast<int>(bin));
    };
    const int border = cheapest_border(range, bin_of);
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(range.begin);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(range.end);
    const auto cut = std::stable_partition(begin, end, [&](std::int32_t p) { return bin_of(p) < border; });
    return cut == begin || cut == end ? middle : static_cast<std::size_t>(cut - order.begin());
  }

  /// The bin before which the sum of area x count over both sides is least.
  template <class BinOf>
  int cheapest_border(Range range, BinOf bin_of) const {
    std::array<Box, bin_count> bins;
    std::array<double, bin_count> counts{};
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(order[i]));
      bins[bin].add(boxes[at(order[i])]);
      ++counts[bin];
    }
    std::array<double, bin_count> right_cost{};
    Box right;
    double right_count = 0;
    for (std::size_t i = bin_count - 1; i > 0; --i) {
      right.add(bins[i]);
      right_count += counts[i];
      right_cost[i] = right_count > 0 ? right_count * right.half_area() : 0;
    }
    Box left;
    double left_count = 0, best = std::numeric_limits<double>::infinity();
    int border = bin_count / 2;
    for (std::size_t i = 1; i < bin_count; ++i) {
      left.add(bins[i - 1]);
      left_count += counts[i - 1];
      const double cost = (left_count > 0 ? left_count * left.half_area() : 0) + right_cost[i];
      if (cost < best) {
        best = cost;
        border = static_cast<int>(i);
      }
    }
    return border;
  }
};

namespace {

/// The bounds of those boxes that have bounds.
Box finite_bounds(const std::vector<Box>& boxes) {
  Box finite;
  for (const Box& box : boxes)
    if (box.lower.allFinite() && box.upper.allFinite()) finite.add(box);
  return finite;
}

}  // namespace

Bvh::Bvh(const std::vector<Box>& boxes) : space_(finite_bounds(boxes)) {
  if (boxes.empty()) return;
  Builder builder{boxes, {}, std::vector<std::int32_t>(boxes.size()), {}};
  builder.centres.reserve(boxes.size());
  for (const Box& box : boxes) builder.centres.push_back(box.centre());
  std::iota(builder.order.begin(), builder.order.end(), 0);
  builder.build();
  depth_ = builder.collapse(nodes_, space_);
  nodes_.shrink_to_fit();
  bounds_ = builder.nodes.front().box;
  middle_ = bounds_.centre();
  half_extents_ = (bounds_.upper - middle_).array() + 0x1p-43 * bounds_.largest_coordinate();
}

}  // namespace shaolin
