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
/// sum symmetrically), to rounding where they are derived. Children are made where refinement goes on. Most subpatches
/// are leaves; so they keep little: siblings share control points, and what follows from the path that leads to a
/// subpatch is worked out when it is asked for.
template <Scheme S>
class ChordNode {
 public:
  using D = Domain<S::face_kind>;
  static constexpr std::size_t sides = D::corner_count;
  struct Root;
  struct Children;

  ChordNode() = default;
  ~ChordNode() {
    delete children_.load();
    if (splits_ == 0) delete root_;
  }

  /// Makes it the root of a start patch.
  void make_root(std::unique_ptr<Root> root, BorderHulls hulls);

  const Configuration<S>& configuration() const { return *configuration_; }
  std::size_t point_count() const { return static_cast<std::size_t>(configuration_->point_count()); }
  const Vec3& point(std::size_t i) const { return points_[order_ ? order_[i] : static_cast<int>(i)]; }
  Patch<S> patch() const;

  const ChordCorner& corner(std::size_t k) const { return *corners_[k]; }
  int level() const { return level_; }
  int splits() const { return splits_; }
  bool is_outer(std::size_t edge) const { return (outer_ >> edge & 1u) != 0; }
  bool is_outer() const { return outer_ != 0; }
  /// Bounds how far points of the hulls of outer edges are from their chords.
  double border_reach() const { return border_reach_; }
  /// Visits points whose hull holds the border curve of an outer edge; edge k joins corner k to the next. O(1) where
  /// that is a polynomial.
  template <class Visit>
  void for_each_border_point(std::size_t edge, Visit visit) const;

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
  /// How far the surface is seen to leave the chord face: cv of section 7.1, and, with `end_normals`, what the normals
  /// at the ends of edges say of it. Found when first asked for; all must ask with the same `end_normals`.
  /// Thread-safe. O(points).
  double deviation(bool end_normals) const;

  /// Of corner k, in the root's face. O(splits).
  Parameter corner_parameter(std::size_t k) const;

  /// Made now if nobody asked before. Thread-safe. O(points).
  const Children& children(BorderHulls hulls, TreeTotals& totals) const;

  struct Neighbour {
    const ChordNode* node = nullptr;
    std::size_t edge = 0;  ///< the shared one, seen from there
  };
  /// The subpatch of the same level across an edge, within the start patch; none across its border. `children_of` says
  /// what to do on the way down to it: it gives a node's children, or null to give up.
  template <class ChildrenOf>
  Neighbour neighbour(std::size_t edge, const ChildrenOf& children_of) const;

  /// Without its children and their points, and of all that there is of these.
  std::uint64_t own_bytes() const;
  std::uint64_t bytes_below() const;

 private:
  /// Of irregular outer edges; those of regular ones follow from the patch.
  using Borders = std::array<std::vector<Vec3>, sides>;

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
  static ChordCorner edge_middle(const std::vector<Patch<S>>& children, std::size_t e) {
    return limit_corner(children[e], static_cast<int>((e + 1) % sides));
  }
  /// At the centre of a quad.
  static ChordCorner centre(const std::vector<Patch<S>>& children) { return limit_corner(children[0], 2); }

  static double distance_from_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 chord = b - a, way = point - a;
    const double square = chord.squaredNorm();
    const double share = square > 0 ? std::clamp(way.dot(chord) / square, 0.0, 1.0) : 0;
    return (way - share * chord).norm();
  }

  double find_deviation(bool end_normals) const;
  std::unique_ptr<Children> split(BorderHulls hulls) const;
  void make_borders(const Patch<S>& patch, BorderHulls hulls);

  const Configuration<S>* configuration_ = nullptr;
  const Vec3* points_ = nullptr;                     ///< of all siblings
  const int* order_ = nullptr;                       ///< which of them are the node's; null: the first
  std::array<const ChordCorner*, sides> corners_{};  ///< the root's own, or what splits of ancestors added
  union {
    const Root* root_ = nullptr;  ///< of the root, which has no splits
    const ChordNode* parent_;     ///< of all others
  };
  std::unique_ptr<Borders> borders_;
  mutable std::atomic<Children*> children_{nullptr};
  mutable std::atomic<double> deviation_{-1};  ///< negative: not known yet
  float border_reach_ = 0;
  std::uint8_t level_ = 0;
  std::uint8_t splits_ = 0, number_ = 0, outer_ = 0;  ///< since the root; among siblings; a bit per edge
};

/// What a start patch's root is made of; parameters are those of the face's (or of the n-gon's corner's) patch: origin
/// + scale * own.
template <Scheme S>
struct ChordNode<S>::Root {
  Patch<S> patch;
  int level = 0;  ///< splits below the control face
  Parameter origin = Parameter::Zero();
  double scale = 1;
  std::array<ChordCorner, sides> corners = {};
};

/// The four subpatches of a split, and the points that it adds.
template <Scheme S>
struct ChordNode<S>::Children {
  std::array<ChordCorner, sides> middles;     ///< of the edges
  std::array<ChordCorner, sides - 3> centre;  ///< of a quad
  std::vector<Vec3> points;
  std::array<ChordNode, 4> nodes;

  /// Of the four alone.
  std::uint64_t bytes() const {
    std::uint64_t bytes = sizeof *this + points.capacity() * sizeof(Vec3);
    for (const ChordNode& child : nodes) bytes += child.own_bytes();
    return bytes;
  }
};

template <Scheme S>
Patch<S> ChordNode<S>::patch() const {
  Patch<S> patch{configuration_, {}};
  patch.points.reserve(point_count());
  for (std::size_t i = 0; i < point_count(); ++i) patch.points.push_back(point(i));
  return patch;
}

template <Scheme S>
std::uint64_t ChordNode<S>::own_bytes() const {
  std::uint64_t bytes = 0;
  if (splits_ == 0 && root_) bytes += sizeof(Root) + root_->patch.points.capacity() * sizeof(Vec3);
  if (borders_) {
    bytes += sizeof(Borders);
    for (const auto& hull : *borders_) bytes += hull.capacity() * sizeof(Vec3);
  }
  return bytes;
}

template <Scheme S>
std::uint64_t ChordNode<S>::bytes_below() const {
  const Children* const children = children_.load(std::memory_order_acquire);
  if (!children) return 0;
  std::uint64_t bytes = children->bytes();
  for (const ChordNode& child : children->nodes) bytes += child.bytes_below();
  return bytes;
}

template <Scheme S>
void ChordNode<S>::make_root(std::unique_ptr<Root> root, BorderHulls hulls) {
  configuration_ = root->patch.configuration;
  points_ = root->patch.points.data();
  level_ = static_cast<std::uint8_t>(root->level);
  for (std::size_t k = 0; k < sides; ++k) {
    root->corners[k] = limit_corner(root->patch, static_cast<int>(k));
    corners_[k] = &root->corners[k];
  }
  outer_ = (1u << sides) - 1;
  make_borders(root->patch, hulls);
  root_ = root.release();
}

template <Scheme S>
void ChordNode<S>::make_borders(const Patch<S>& patch, BorderHulls hulls) {
  // To a millionth of the start patch's edge, and a thirty-second of the node's where nothing becomes polynomial.
  constexpr int splits = 5, halvings = 20;
  if (!is_outer() || hulls == BorderHulls::none) return;
  if (!patch.is_regular()) borders_ = std::make_unique<Borders>();
  double reach = 0;
  for (std::size_t edge = 0; edge < sides; ++edge) {
    if (!is_outer(edge)) continue;
    const int number = static_cast<int>(edge);
    std::vector<Vec3> points;
    if (hulls != BorderHulls::stand_ins || patch.is_regular() || !add_stand_in(patch, number, points))
      add_border_bound(patch, number, splits, std::max(1, halvings - splits_), points);
    check_finite(points);
    for (const Vec3& point : points)
      reach = std::max(reach, distance_from_segment(point, corner(edge).position, corner((edge + 1) % sides).position));
    points.shrink_to_fit();
    if (borders_) (*borders_)[edge] = std::move(points);
  }
  border_reach_ = std::nextafter(static_cast<float>(reach), std::numeric_limits<float>::infinity());
}

template <Scheme S>
template <class Visit>
void ChordNode<S>::for_each_border_point(std::size_t edge, Visit visit) const {
  if (borders_) {
    for (const Vec3& point : (*borders_)[edge]) visit(point);
    return;
  }
  std::vector<Vec3> points;
  add_border_bound(patch(), static_cast<int>(edge), 0, 0, points);
  for (const Vec3& point : points) visit(point);
}

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
Parameter ChordNode<S>::corner_parameter(std::size_t k) const {
  Parameter at(D::corners[k][0], D::corners[k][1]);
  const ChordNode* node = this;
  for (; node->splits_ > 0; node = node->parent_) at = D::to_parent(node->number_, at);
  return node->root_->origin + node->root_->scale * at;
}

template <Scheme S>
double ChordNode<S>::deviation(bool end_normals) const {
  double known = deviation_.load(std::memory_order_relaxed);
  if (known < 0) {
    known = find_deviation(end_normals);
    deviation_.store(known, std::memory_order_relaxed);  // all who ask find the same
  }
  return known;
}

template <Scheme S>
double ChordNode<S>::find_deviation(bool end_normals) const {
  const std::vector<Patch<S>> children = patch().children();
  double deviation = 0;
  const auto leave = [&](const ChordCorner& middle, const ChordCorner& a, const ChordCorner& b) {
    deviation = std::max(deviation, distance_from_segment(middle.position, a.position, b.position));
  };
  for (std::size_t e = 0; e < sides; ++e) {
    const ChordCorner &a = corner(e), &b = corner((e + 1) % sides);
    check_finite(children[e].points);
    leave(edge_middle(children, e), a, b);
    if (!end_normals) continue;
    // A parabola leaves its chord by a quarter of (chord . end normal).
    for (const Vec3& normal : {a.normal, b.normal})
      deviation = std::max(deviation, 0.25 * std::abs(normal.dot(b.position - a.position)));
  }
  if constexpr (sides == 4) leave(centre(children), corner(0), corner(2));  // the diagonal along which the quad is cut
  return deviation;
}

template <Scheme S>
auto ChordNode<S>::children(BorderHulls hulls, TreeTotals& totals) const -> const Children& {
  if (const Children* known = children_.load(std::memory_order_acquire)) return *known;
  std::unique_ptr<Children> made = split(hulls);
  Children* expected = nullptr;
  if (!children_.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  totals.bytes += made->bytes();
  ++totals.patches_split;
  return *made.release();
}

/// Edge e of the parent is edge e of child e and of child e + 1 in both splits.
template <Scheme S>
auto ChordNode<S>::split(BorderHulls hulls) const -> std::unique_ptr<Children> {
  auto made = std::make_unique<Children>();
  const auto& split = configuration_->split();
  const std::vector<Patch<S>> patches = patch().children(made->points);
  check_finite(made->points);
  for (std::size_t e = 0; e < sides; ++e) made->middles[e] = edge_middle(patches, e);
  if constexpr (sides == 4) made->centre[0] = centre(patches);
  for (std::size_t k = 0; k < 4; ++k) {
    ChordNode& child = made->nodes[k];
    child.configuration_ = split.children[k].configuration;
    child.points_ = made->points.data();
    child.order_ = split.children[k].points.data();
    child.level_ = static_cast<std::uint8_t>(level_ + 1);
    child.splits_ = static_cast<std::uint8_t>(splits_ + 1);
    child.number_ = static_cast<std::uint8_t>(k);
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
    child.outer_ = static_cast<std::uint8_t>(outer_ & (1u << k | 1u << before));
    child.make_borders(patches[k], hulls);
  }
  return made;
}

/// Triangles: across edge k + 1 of child k lies the middle child, by its edge of the same number. Quads: across edge
/// k + 1 of child k lies edge k + 3 of child k + 1. All children wind like the parent, so halves of an edge are met in
/// opposite order from its other side.
template <Scheme S>
template <class ChildrenOf>
auto ChordNode<S>::neighbour(std::size_t edge, const ChildrenOf& children_of) const -> Neighbour {
  if (is_outer(edge) || splits_ == 0) return {};
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
