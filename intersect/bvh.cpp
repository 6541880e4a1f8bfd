#include "bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shaolin {

namespace {

/// A box as eight floats of which unions take the larger, place by place: lower bounds with their signs turned, and
/// upper ones. It may carry a number in the fourth place.
struct Bounds {
  alignas(32) std::array<float, 8> side;

  static Bounds empty() {
    Bounds result;
    result.side.fill(-std::numeric_limits<float>::infinity());
    return result;
  }
  Bounds() = default;
  Bounds(const SceneBox& box, std::int32_t number) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side[axis] = -box.bounds[0][axis];
      side[axis + 4] = box.bounds[1][axis];
    }
    side[3] = side[7] = std::bit_cast<float>(number + first_normal);
  }

  /// (What is undefined in the other adds nothing.)
  void add(const Bounds& other) { larger(Eight(other.side.data()), Eight(side.data())).store(side.data()); }
  /// 0 of a box that goes from one infinity to the other.
  float twice_centre(std::size_t axis) const {
    const float sum = side[axis + 4] - side[axis];
    return std::isnan(sum) ? 0 : sum;
  }
  float extent(std::size_t axis) const { return side[axis + 4] + side[axis]; }
  float half_area() const { return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0); }
  std::int32_t number() const { return std::bit_cast<std::int32_t>(side[3]) - first_normal; }
  SceneBox box() const {
    SceneBox result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.bounds[0][axis] = -side[axis];
      result.bounds[1][axis] = side[axis + 4];
    }
    return result;
  }

 private:
  static constexpr std::int32_t first_normal = 0x00800000;  ///< whose bits are those of a normal float
};

/// Of boxes, and of their centres (twice as far out).
struct Extents {
  Bounds boxes = Bounds::empty(), centres = Bounds::empty();

  void take(const Bounds& box) {
    Bounds centre;
    for (std::size_t i = 0; i < 4; ++i) {
      const float at = box.side[i + 4] - box.side[i];
      centre.side[i] = -at;
      centre.side[i + 4] = at;
    }
    boxes.add(box);
    centres.add(centre);
  }
  void add(const Extents& other) {
    boxes.add(other.boxes);
    centres.add(other.centres);
  }
};

}  // namespace

/// From the top: what a node holds is cut in two again and again, the largest part first, until there are eight parts.
/// Parts of up to eight primitives become nodes without further cuts. Small ranges are cut where a multiple of eight is
/// left on one side if that costs little more than elsewhere, so that these nodes are full where it does no harm: a
/// node takes 224 bytes, whoever shares them. (Always cut so, rays at the rook went through a sixth more instructions.)
struct Bvh::Builder {
  static constexpr int bin_count = 16;
  static constexpr std::size_t most_in_order = 32;
  static constexpr float dearer = 1.15F;  ///< that a cut at a multiple of eight may be

  /// Of items.
  struct Range {
    std::size_t begin, end;
    Extents extents;

    std::size_t size() const { return end - begin; }
    float half_area() const { return extents.boxes.half_area(); }
  };
  struct Task {
    std::size_t node;
    Range range;
    int depth;
  };

  std::vector<Bounds> items;
  std::vector<Node>& nodes;

  /// Returns the depth.
  int build() {
    int depth = 0;
    nodes.reserve(items.size() / 6 + 1);
    nodes.emplace_back();
    std::vector<Task> tasks{{0, range(0, items.size()), 1}};
    while (!tasks.empty()) {
      const Task task = tasks.back();
      tasks.pop_back();
      depth = std::max(depth, task.depth);
      const std::vector<Range> parts = this->parts(task.range);
      for (std::size_t i = 0; i < parts.size(); ++i) {
        std::int32_t child = ~items[parts[i].begin].number();
        if (parts[i].size() > 1) {
          child = static_cast<std::int32_t>(nodes.size());
          nodes.emplace_back();
          tasks.push_back({static_cast<std::size_t>(child), parts[i], task.depth + 1});
        }
        nodes[task.node].boxes.set(i, parts[i].extents.boxes.box());
        nodes[task.node].child[i] = child;
      }
    }
    return depth;
  }

  Range range(std::size_t begin, std::size_t end) const {
    Range result{begin, end, {}};
    for (std::size_t i = begin; i < end; ++i) result.extents.take(items[i]);
    return result;
  }

  /// What a node of these items holds: eight parts at most.
  std::vector<Range> parts(const Range& whole) {
    std::vector<Range> parts{whole};
    while (parts.size() < width) {
      std::size_t open = parts.size();
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].size() > width && (open == parts.size() || parts[i].half_area() > parts[open].half_area()))
          open = i;
      if (open == parts.size()) break;
      const auto [left, right] = split(parts[open]);
      parts[open] = left;
      parts.push_back(right);
    }
    // Small parts need no nodes of their own as long as there is room for their primitives.
    for (;;) {
      const auto smallest = std::min_element(parts.begin(), parts.end(), [](const Range& a, const Range& b) {
        return (a.size() == 1 ? width + 1 : a.size()) < (b.size() == 1 ? width + 1 : b.size());
      });
      const Range part = *smallest;
      if (part.size() == 1 || parts.size() - 1 + part.size() > width) return parts;
      parts.erase(smallest);
      for (std::size_t i = part.begin; i < part.end; ++i) parts.push_back(range(i, i + 1));
    }
  }

  /// At the cheapest place on the longest axis of the centres, or in the middle if all centres are one; reorders the
  /// items.
  std::array<Range, 2> split(const Range& whole) {
    const Bounds& centres = whole.extents.centres;
    const std::size_t of_two = centres.extent(1) > centres.extent(0) ? 1 : 0;
    const std::size_t axis = centres.extent(2) > centres.extent(of_two) ? 2 : of_two;
    const float length = centres.extent(axis);
    if (!(length > 0 && std::isfinite(length))) return halves(whole);
    if (whole.size() <= most_in_order) return split_in_order(whole, axis);
    const float first = -centres.side[axis], scale = bin_count / length;
    const auto bin_of = [&](const Bounds& item) {
      const float bin = (item.twice_centre(axis) - first) * scale;
      return bin > 0 ? static_cast<int>(std::min<float>(bin, bin_count - 1)) : 0;
    };
    const std::optional<Border> border = cheapest_border(whole, bin_of);
    if (!border) return halves(whole);
    std::partition(at(whole.begin), at(whole.end), [&](const Bounds& item) { return bin_of(item) < border->bin; });
    const std::size_t cut = whole.begin + border->before;
    return {Range{whole.begin, cut, border->left}, Range{cut, whole.end, border->right}};
  }
  std::array<Range, 2> halves(const Range& whole) const {
    const std::size_t cut = whole.begin + whole.size() / 2;
    return {range(whole.begin, cut), range(cut, whole.end)};
  }
  std::vector<Bounds>::iterator at(std::size_t item) { return items.begin() + static_cast<std::ptrdiff_t>(item); }

  /// Few items: by all places between two of them.
  std::array<Range, 2> split_in_order(const Range& whole, std::size_t axis) {
    std::sort(at(whole.begin), at(whole.end), [&](const Bounds& a, const Bounds& b) {
      return std::pair(a.twice_centre(axis), a.number()) < std::pair(b.twice_centre(axis), b.number());
    });
    const std::size_t size = whole.size();
    std::array<Extents, most_in_order> right;  // from each item on
    for (std::size_t i = size; i-- > 1;) {
      if (i + 1 < size) right[i] = right[i + 1];
      right[i].take(items[whole.begin + i]);
    }
    struct Cut {
      float cost = std::numeric_limits<float>::infinity();
      std::size_t before = 0;
      Extents left;
    };
    Cut cheapest, of_eights;
    Extents left;
    for (std::size_t before = 1; before < size; ++before) {
      left.take(items[whole.begin + before - 1]);
      const float cost = static_cast<float>(before) * left.boxes.half_area() +
                         static_cast<float>(size - before) * right[before].boxes.half_area();
      if (cost < cheapest.cost) cheapest = {cost, before, left};
      if ((before % width == 0 || (size - before) % width == 0) && cost < of_eights.cost)
        of_eights = {cost, before, left};
    }
    const Cut& cut = of_eights.cost <= dearer * cheapest.cost ? of_eights : cheapest;
    if (cut.before == 0) return halves(whole);
    const std::size_t middle = whole.begin + cut.before;
    return {Range{whole.begin, middle, cut.left}, Range{middle, whole.end, right[cut.before]}};
  }

  /// A bin, how many items are in those before it, and what is on either side.
  struct Border {
    int bin;
    std::size_t before;
    Extents left, right;
  };

  /// The bin before which the sum of area x count over both sides is least; none if all items are in one.
  template <class BinOf>
  std::optional<Border> cheapest_border(const Range& whole, BinOf bin_of) const {
    std::array<Extents, bin_count> bins;
    std::array<std::size_t, bin_count> counts{};
    for (std::size_t i = whole.begin; i < whole.end; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(items[i]));
      bins[bin].take(items[i]);
      ++counts[bin];
    }
    std::array<Extents, bin_count> right;
    right.back() = bins.back();
    for (std::size_t i = bin_count - 1; i > 1; --i) {
      right[i - 1] = bins[i - 1];
      right[i - 1].add(right[i]);
    }
    Extents left;
    float best = std::numeric_limits<float>::infinity();
    std::optional<Border> border;
    for (std::size_t i = 1, before = 0; i < bin_count; ++i) {
      left.add(bins[i - 1]);
      before += counts[i - 1];
      if (before == 0 || before == whole.size()) continue;
      const float cost = static_cast<float>(before) * left.boxes.half_area() +
                         static_cast<float>(whole.size() - before) * right[i].boxes.half_area();
      if (!(cost < best)) continue;
      best = cost;
      border = {static_cast<int>(i), before, left, right[i]};
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
  Builder builder{{}, nodes_};
  builder.items.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if ((boxes[i].lower.array() > boxes[i].upper.array()).any()) continue;
    builder.items.emplace_back(SceneBox(boxes[i], space_), static_cast<std::int32_t>(i));
    bounds_.add(boxes[i]);
  }
  if (builder.items.empty()) return;
  depth_ = builder.build();
  nodes_.shrink_to_fit();
  middle_ = bounds_.centre();
  half_extents_ = (bounds_.upper - middle_).array() + 0x1p-43 * bounds_.largest_coordinate();
}

}  // namespace shaolin
