#pragma once
/// A bounding volume hierarchy over boxes, eight children a node, one primitive a leaf; boxes in single precision.
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "box_point.h"
#include "nearest_queue.h"

namespace shaolin {

class Bvh {
 public:
  Bvh() = default;
  /// Surface-area heuristic over 16 bins of centroids (Wald 2007); empty boxes are left out. Deterministic. O(n log n).
  explicit Bvh(const std::vector<Box>& boxes);

  /// True if the ray's whole line passes by the bounds: asked before all else, for it needs neither a root nor a
  /// quotient, and half of a picture's rays may miss. (False says nothing.)
  ///
  /// On either side of a plane through the line and an axis, by the products m_i d_j - m_j d_i, with m from the middle
  /// of the bounds. Each product is off by 3 u, so their difference by less than 4 u |m| (|d_i| + |d_j|), far below
  /// what half extents have as room: a finish takes points for hits that are up to 320 u of the largest coordinate and
  /// 128 u of the distance beside the ray (RayFrame::error(), twice), and at a corner of the bounds may find one there.
  /// Where products might underflow nothing is said.
  bool is_passed_by(const Ray& ray) const {
    const Vec3 m = ray.origin - middle_, d = ray.direction.cwiseAbs();
    const double distance = m.cwiseAbs().maxCoeff();
    const Vec3 half = half_extents_ + Vec3::Constant(0x1p-45 * distance);
    if (!(half.maxCoeff() * d.maxCoeff() > 0x1p-900)) return false;
    const auto is_beside = [&](Eigen::Index i, Eigen::Index j) {
      return std::abs(m[i] * ray.direction[j] - m[j] * ray.direction[i]) > half[i] * d[j] + half[j] * d[i];
    };
    return is_beside(0, 1) || is_beside(1, 2) || is_beside(2, 0);
  }

  /// The ray in the coordinates of the boxes: counted from its origin or, if that is far away, from where it enters the
  /// bounds. Empty if it comes from afar and misses them.
  std::optional<BoxRay> enter(const TraversalRay& ray) const {
    constexpr double nearby = 16;  // half extents: single precision takes 4e-6 of one there
    if (space_(ray.origin).cwiseAbs().maxCoeff() <= nearby) return BoxRay(ray, space_, 0);
    const std::optional<double> entry = entry_distance(bounds_, ray, ray.far);
    if (!entry) return {};
    return BoxRay(ray, space_, std::max(*entry, ray.near));
  }

  /// Calls visit(primitive) for the primitives whose boxes the ray meets before `far()`, nearest box first within each
  /// node, and perhaps for some that it misses by less than 4e-6 of the scene's extent; `far()`, in the ray's units,
  /// may shrink meanwhile. Stops when visit returns true.
  template <class Far, class Visit>
  void traverse(const BoxRay& ray, Far far, Visit visit) const;

  /// Calls visit(primitive, distance) for the primitives whose boxes are not farther from the point than `far()`,
  /// nearest box first; distances are in the point's units, and `far()` may shrink meanwhile.
  template <class Far, class Visit>
  void nearest_first(const BoxPoint& point, Far far, Visit visit) const;

  /// Calls visit(child, box) for what a node leads to, in their order: `child` is a node or ~primitive, `box` is in the
  /// coordinates of the boxes that the hierarchy was made of. Node 0 is the root of a hierarchy that is not empty.
  template <class Visit>
  void open(std::int32_t node, Visit visit) const {
    const Node& at = nodes_[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; i < width; ++i)
      if (!at.boxes.is_empty(i)) visit(at.child[i], at.boxes.box(i).in_object(space_));
  }

  std::size_t bytes() const { return nodes_.size() * sizeof(Node); }
  const Box& bounds() const { return bounds_; }
  const BoxSpace& space() const { return space_; }

 private:
  static constexpr std::size_t width = 8;

  /// Boxes and what stands in them: a node, ~primitive, or nothing (an empty box).
  struct Node {
    EightBoxes boxes;
    std::array<std::int32_t, width> child{};
  };
  struct Builder;

  std::vector<Node> nodes_;
  Box bounds_;
  Vec3 middle_ = Vec3::Zero(), half_extents_ = Vec3::Zero();  ///< of the bounds, the latter with room for rounding
  BoxSpace space_;
  int depth_ = 0;
};

template <class Far, class Visit>
void Bvh::traverse(const BoxRay& ray, Far far, Visit visit) const {
  if (nodes_.empty()) return;
  // Every level leaves at most width - 1 entries behind.
  constexpr std::size_t usual = 192;
  std::array<MetBox, usual> fixed;
  std::vector<MetBox> large;
  MetBox* stack = fixed.data();
  if (const auto most = (width - 1) * static_cast<std::size_t>(depth_) + 1; most > usual) {
    large.resize(most);
    stack = large.data();
  }
  MetBox* top = stack;
  MetBox next(0, 0);  // in hand: most nodes lead on to one child or none
  alignas(32) std::array<float, width> entries;
  for (;;) {
    bool leads_on = false;
    if (next.what() < 0) {
      if (visit(~next.what())) return;
    } else {
      const Node& node = nodes_[static_cast<std::size_t>(next.what())];
      if (unsigned met = ray.meet(node.boxes, far(), entries); met != 0) {
        const auto take = [&] {
          const auto i = static_cast<std::size_t>(std::countr_zero(met));
          met &= met - 1;
          return MetBox(entries[i], node.child[i]);
        };
        leads_on = true;
        next = take();
        MetBox* const first = top;
        while (met != 0) {  // NOLINT(bugprone-infinite-loop): take() changes it
          // Which is nearer is for no branch to guess: each goes past all that are there, the farthest first.
          MetBox nearer = take();
          for (MetBox* at = first; at != top; ++at) put_in_order(nearer, *at);
          put_in_order(next, nearer);
          *top++ = nearer;
        }
      }
    }
    while (!leads_on) {
      if (top == stack) return;
      next = *--top;
      leads_on = next.distance() <= far();
    }
  }
}

template <class Far, class Visit>
void Bvh::nearest_first(const BoxPoint& point, Far far, Visit visit) const {
  if (nodes_.empty()) return;
  NearestQueue<std::int32_t> queue;
  queue.push(-std::numeric_limits<float>::infinity(), 0);
  alignas(32) std::array<float, width> entries;
  while (!queue.empty() && queue.distance() <= far()) {
    const float distance = queue.distance();
    const std::int32_t child = queue.pop();
    if (child < 0) {
      visit(~child, distance);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(child)];
    for (unsigned met = point.meet(node.boxes, far(), entries); met != 0; met &= met - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(met));
      queue.push(entries[i], node.child[i]);
    }
  }
}

}  // namespace shaolin
