#include "bvh.h"

#include <algorithm>
#include <array>

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

  void add(const Bounds& other) { larger(Eight(side.data()), Eight(other.side.data())).store(side.data()); }
  float twice_centre(std::size_t axis) const { return side[axis + 4] - side[axis]; }
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
/// Parts of up to eight primitives become nodes without further cuts. Below some size all cuts leave a multiple of
/// eight on one side, so that these nodes are full: a node takes 224 bytes, of which a primitive's share would be twice
/// as much otherwise.
struct Bvh::Builder {
  static constexpr int bin_count = 16;
  static constexpr std::size_t most_in_multiples = 64;

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

  /// At the cheapest of the bins' borders on the longest axis of the centres, or in the middle if all centres fall into
  /// one bin; reorders the items.
  std::array<Range, 2> split(const Range& whole) {
    const Bounds& centres = whole.extents.centres;
    const std::size_t of_two = centres.extent(1) > centres.extent(0) ? 1 : 0;
    const std::size_t axis = centres.extent(2) > centres.extent(of_two) ? 2 : of_two;
    const float length = centres.extent(axis);
    const bool is_spread = length > 0 && std::isfinite(length);
    const float first = -centres.side[axis], scale = is_spread ? bin_count / length : 0;
    const auto bin_of = [&](const Bounds& item) {
      return std::min(bin_count - 1, static_cast<int>((item.twice_centre(axis) - first) * scale));
    };
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(whole.begin);
    const auto end = items.begin() + static_cast<std::ptrdiff_t>(whole.end);
    const std::optional<Border> border = is_spread ? cheapest_border(whole, bin_of) : std::nullopt;
    if (border && whole.size() > most_in_multiples) {
      std::partition(begin, end, [&](const Bounds& item) { return bin_of(item) < border->bin; });
      const std::size_t cut = whole.begin + border->before;
      return {Range{whole.begin, cut, border->left}, Range{cut, whole.end, border->right}};
    }
    std::size_t before = border ? border->before : whole.size() / 2;
    before = std::clamp((before + width / 2) / width * width, width, (whole.size() - 1) / width * width);
    const std::size_t cut = whole.begin + before;
    if (is_spread)
      std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(before), end, [&](const Bounds& a, const Bounds& b) {
        return std::pair(a.twice_centre(axis), a.number()) < std::pair(b.twice_centre(axis), b.number());
      });
    return {range(whole.begin, cut), range(cut, whole.end)};
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
  for (const Box& box : boxes) {
    builder.items.emplace_back(SceneBox(box, space_), static_cast<std::int32_t>(builder.items.size()));
    bounds_.add(box);
  }
  depth_ = builder.build();
  nodes_.shrink_to_fit();
  middle_ = bounds_.centre();
  half_extents_ = (bounds_.upper - middle_).array() + 0x1p-43 * bounds_.largest_coordinate();
}

}  // namespace shaolin
