#pragma once
/// The subpatches of a start patch with the limit points that their chord faces are spanned by.
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "../schemes/evaluate.h"
#include "../schemes/scheme_surface.h"
#include "border.h"
#include "check_finite.h"
#include "tree_totals.h"

namespace shaolin {

/// A corner of chord faces: a limit point and the unit limit normal there (zero where there is none).
struct ChordCorner {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
};

/// A subpatch: its control points N(F), its corners' limit points, and hulls of those of its border curves that lie on
/// the start patch's border. The corners of children are the parent's corners and the limit points of its edges'
/// middles, bit for bit; across the border of start patches they agree bit for bit where limit masks are closed (they
/// sum symmetrically), to rounding where they are derived. Children are made where refinement goes on; leaves, which
/// are most of the subpatches, keep what the criteria ask for, and not the limit points that it was found by.
template <Scheme S>
class ChordNode {
 public:
  using D = Domain<S::face_kind>;
  static constexpr std::size_t sides = D::corner_count;
  struct Shape;
  struct Children;
  /// Of an outer edge.
  struct Border {
    std::vector<Vec3> hull;  ///< points whose hull holds the border curve
    double reach = 0;        ///< the largest distance of one of them from the chord
  };
  using Borders = std::array<Border, sides>;

  ChordNode() = default;
  ~ChordNode() {
    delete children_.load();
    delete shape_.load();
  }

  /// Makes it the root of a start patch, `level` splits below the control face; parameters are those of the face's (or
  /// of the n-gon's corner's) patch: origin + scale * own.
  void make_root(Patch<S> patch, int level, const Parameter& origin, double scale, BorderHulls hulls) {
    patch_ = std::move(patch);
    level_ = root_level_ = level;
    origin_ = origin;
    scale_ = scale;
    own_corners_ = std::make_unique<std::array<ChordCorner, sides>>();
    for (std::size_t k = 0; k < sides; ++k) {
      (*own_corners_)[k] = limit_corner(patch_, static_cast<int>(k));
      corners_[k] = &(*own_corners_)[k];
    }
    outer_ = (1u << sides) - 1;
    make_borders(hulls);
  }

  const Patch<S>& patch() const { return patch_; }
  const ChordCorner& corner(std::size_t k) const { return *corners_[k]; }
  int level() const { return level_; }
  int splits() const { return level_ - root_level_; }
  bool is_outer(std::size_t edge) const { return (outer_ >> edge & 1u) != 0; }
  bool is_outer() const { return outer_ != 0; }
  /// Of an outer edge; edge k joins corner k to the next.
  const Border& border(std::size_t edge) const { return (*borders_)[edge]; }
  /// The unit normal of the chord face (of section 8.2 for quads); zero if it has none.
  Vec3 normal() const;
  /// The length of the longest chord, as it is or as a map of vectors makes it.
  template <class Map = std::identity>
  double longest_chord(Map map = {}) const {
    double square = 0;
    for (std::size_t k = 0; k < sides; ++k)
      square = std::max(square, map(Vec3(corner((k + 1) % sides).position - corner(k).position)).squaredNorm());
    return std::sqrt(square);
  }

  Parameter to_face(const Parameter& at) const { return origin_ + scale_ * at; }
  Parameter corner_parameter(std::size_t k) const { return to_face({D::corners[k][0], D::corners[k][1]}); }

  /// Both are made now if nobody asked before. Thread-safe. O(points).
  const Shape& shape(TreeTotals& totals) const;
  const Children& children(BorderHulls hulls, TreeTotals& totals) const;

  struct Neighbour {
    const ChordNode* node = nullptr;
    std::size_t edge = 0;  ///< the shared one, seen from there
  };
  /// The subpatch of the same level across an edge, within the start patch; none across its border. `children_of` says
  /// what to do on the way down to it: it gives a node's children, or null to give up.
  template <class ChildrenOf>
  Neighbour neighbour(std::size_t edge, const ChildrenOf& children_of) const;

  std::uint64_t own_bytes() const {
    std::uint64_t bytes = patch_.points.capacity() * sizeof(Vec3) + (own_corners_ ? sizeof(*own_corners_) : 0);
    if (borders_) {
      bytes += sizeof(Borders);
      for (const auto& border : *borders_) bytes += border.hull.capacity() * sizeof(Vec3);
    }
    return bytes;
  }

 private:
  /// The limit at a corner, once splits towards it have left sharpness and n-gons behind. (A scheme that does not
  /// converge never gets there.)
  static ChordCorner limit_corner(Patch<S> patch, int k) {
    for (int level = 0; level < detail::most_levels; ++level) {
      if (const std::optional<LimitSample> limit = evaluate_corner(patch, k)) return {limit->position, limit->normal};
      patch = patch.child(k);
    }
    return {patch.points[static_cast<std::size_t>(k)], Vec3::Zero()};
  }
  /// The limit at the middle of edge e: corner e + 1 of child e in both splits.
  static ChordCorner edge_middle(const Patch<S>& child, std::size_t e) {
    return limit_corner(child, static_cast<int>((e + 1) % sides));
  }

  static double distance_from_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 chord = b - a, way = point - a;
    const double square = chord.squaredNorm();
    const double share = square > 0 ? std::clamp(way.dot(chord) / square, 0.0, 1.0) : 0;
    return (way - share * chord).norm();
  }

  void make_borders(BorderHulls hulls) {
    // To a millionth of the edge, and a thirty-second where nothing becomes polynomial.
    constexpr int splits = 5, halvings = 20;
    if (!is_outer() || hulls == BorderHulls::none) return;
    borders_ = std::make_unique<Borders>();
    for (std::size_t edge = 0; edge < sides; ++edge) {
      if (!is_outer(edge)) continue;
      auto& [points, reach] = (*borders_)[edge];
      const int number = static_cast<int>(edge);
      if (hulls != BorderHulls::stand_ins || patch_.is_regular() || !add_stand_in(patch_, number, points))
        add_border_bound(patch_, number, splits, halvings, points);
      check_finite(points);
      points.shrink_to_fit();
      for (const Vec3& point : points)
        reach =
            std::max(reach, distance_from_segment(point, corner(edge).position, corner((edge + 1) % sides).position));
    }
  }

  /// What `slot` holds, made now if nobody made it before.
  template <class Value, class Make, class Made>
  static const Value& once(std::atomic<Value*>& slot, Make make, Made made_first) {
    if (const Value* known = slot.load(std::memory_order_acquire)) return *known;
    std::unique_ptr<Value> made = make();
    Value* expected = nullptr;
    if (!slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
    made_first(*made);
    return *made.release();
  }

  std::unique_ptr<Shape> find_shape() const;
  std::unique_ptr<Children> split(BorderHulls hulls) const;

  Patch<S> patch_;
  std::array<const ChordCorner*, sides> corners_{};              ///< the root's own, or what splits of ancestors added
  std::unique_ptr<std::array<ChordCorner, sides>> own_corners_;  ///< the root's
  std::unique_ptr<Borders> borders_;
  Parameter origin_ = Parameter::Zero();
  double scale_ = 1;
  int level_ = 0, root_level_ = 0;
  unsigned outer_ = 0;
  int number_ = 0;  ///< among its siblings
  const ChordNode* parent_ = nullptr;
  mutable std::atomic<Shape*> shape_{nullptr};
  mutable std::atomic<Children*> children_{nullptr};
};

/// How the surface is seen to leave the chord face.
template <Scheme S>
struct ChordNode<S>::Shape {
  Vec3 normal;               ///< of the chord face
  double deviation = 0;      ///< cv of section 7.1
  double end_deviation = 0;  ///< what the normals at the ends of edges say of it
};

/// The four subpatches of a split, and the limit points that it adds.
template <Scheme S>
struct ChordNode<S>::Children {
  std::array<ChordCorner, sides> middles;     ///< of the edges
  std::array<ChordCorner, sides - 3> centre;  ///< of a quad
  std::array<ChordNode, 4> nodes;
};

template <Scheme S>
Vec3 ChordNode<S>::normal() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < sides; ++k) {
    const Vec3 &a = corner((k + sides - 1) % sides).position, &b = corner(k).position;
    sum += (b - a).cross(corner((k + 1) % sides).position - b);
  }
  const Vec3 normal = sum.stableNormalized();
  return normal.allFinite() ? normal : Vec3(Vec3::Zero());
}

template <Scheme S>
auto ChordNode<S>::shape(TreeTotals& totals) const -> const Shape& {
  return once(
      shape_, [&] { return find_shape(); }, [&](const Shape&) { totals.bytes += sizeof(Shape); });
}

template <Scheme S>
auto ChordNode<S>::children(BorderHulls hulls, TreeTotals& totals) const -> const Children& {
  return once(
      children_, [&] { return split(hulls); },
      [&](const Children& made) {
        std::uint64_t bytes = sizeof(Children);
        for (const ChordNode& child : made.nodes) bytes += child.own_bytes();
        totals.bytes += bytes;
        ++totals.patches_split;
      });
}

template <Scheme S>
auto ChordNode<S>::find_shape() const -> std::unique_ptr<Shape> {
  auto made = std::make_unique<Shape>();
  made->normal = normal();
  for (std::size_t e = 0; e < sides; ++e) {
    const ChordCorner &a = corner(e), &b = corner((e + 1) % sides);
    const Patch<S> child = patch_.child(static_cast<int>(e));
    check_finite(child.points);
    made->deviation =
        std::max(made->deviation, distance_from_segment(edge_middle(child, e).position, a.position, b.position));
    // A parabola leaves its chord by a quarter of (chord . end normal).
    for (const Vec3& normal : {a.normal, b.normal})
      made->end_deviation = std::max(made->end_deviation, 0.25 * std::abs(normal.dot(b.position - a.position)));
    if (sides == 4 && e == 0)  // from the diagonal along which the quad is cut
      made->deviation = std::max(made->deviation, distance_from_segment(limit_corner(child, 2).position,
                                                                        corner(0).position, corner(2).position));
  }
  return made;
}

/// Edge e of the parent is edge e of child e and of child e + 1 in both splits.
template <Scheme S>
auto ChordNode<S>::split(BorderHulls hulls) const -> std::unique_ptr<Children> {
  auto made = std::make_unique<Children>();
  for (std::size_t k = 0; k < 4; ++k) {
    made->nodes[k].patch_ = patch_.child(static_cast<int>(k));
    check_finite(made->nodes[k].patch_.points);
  }
  for (std::size_t e = 0; e < sides; ++e) made->middles[e] = edge_middle(made->nodes[e].patch_, e);
  if constexpr (sides == 4) made->centre[0] = limit_corner(made->nodes[0].patch_, 2);
  for (std::size_t k = 0; k < 4; ++k) {
    ChordNode& child = made->nodes[k];
    const int number = static_cast<int>(k);
    child.origin_ = to_face(D::to_parent(number, Parameter::Zero()));
    child.scale_ = scale_ * D::scale(number);
    child.level_ = level_ + 1;
    child.root_level_ = root_level_;
    child.number_ = number;
    child.parent_ = this;
    if (k == sides) {  // the middle triangle
      for (std::size_t i = 0; i < sides; ++i) child.corners_[i] = &made->middles[(i + 1) % sides];
      continue;
    }
    const std::size_t before = (k + sides - 1) % sides;
    child.corners_[k] = corners_[k];
    child.corners_[(k + 1) % sides] = &made->middles[k];
    if constexpr (sides == 4) child.corners_[(k + 2) % sides] = &made->centre[0];
    child.corners_[before] = &made->middles[before];
    child.outer_ = outer_ & (1u << k | 1u << before);
    child.make_borders(hulls);
  }
  return made;
}

/// Triangles: across edge k + 1 of child k lies the middle child, by its edge of the same number. Quads: across edge
/// k + 1 of child k lies edge k + 3 of child k + 1. All children wind like the parent, so halves of an edge are met in
/// opposite order from its other side.
template <Scheme S>
template <class ChildrenOf>
auto ChordNode<S>::neighbour(std::size_t edge, const ChildrenOf& children_of) const -> Neighbour {
  if (is_outer(edge) || !parent_) return {};
  const auto k = static_cast<std::size_t>(number_);
  const Children& siblings = *parent_->children_.load(std::memory_order_acquire);
  if constexpr (sides == 3) {
    if (k == 3) return {&siblings.nodes[(edge + 2) % 3], edge};
    if (edge == (k + 1) % 3) return {&siblings.nodes[3], edge};
  } else {
    if (edge == (k + 1) % 4) return {&siblings.nodes[(k + 1) % 4], (k + 3) % 4};
    if (edge == (k + 2) % 4) return {&siblings.nodes[(k + 3) % 4], k};
  }
  const Neighbour above = parent_->neighbour(edge, children_of);
  if (!above.node) return {};
  const Children* cousins = children_of(*above.node);
  if (!cousins) return {};
  const bool first_half = k == edge;
  return {&cousins->nodes[first_half ? (above.edge + 1) % sides : above.edge], above.edge};
}

}  // namespace shaolin
