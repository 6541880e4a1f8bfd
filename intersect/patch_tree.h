#pragma once
/// The patches of one face, split lazily and kept: a node's children are made when a ray first needs them.
#include <atomic>
#include <memory>

#include "../schemes/patch.h"
#include "box.h"

namespace shaolin {

/// Bytes and splits over all trees of a scene.
struct TreeTotals {
  std::atomic<std::uint64_t> bytes{0};
  std::atomic<std::uint64_t> patches_split{0};
};

/// A patch with the affine map of its parameters to those of the tree's root. Regular patches hold their polynomial's
/// Bezier points, irregular ones a configuration and control points; either way the limit lies in the points' hull.
/// Whether a patch is a leaf depends on the patch alone, so the tree that rays grow is the same in whatever order they
/// come.
template <Scheme S>
class PatchNode {
 public:
  using Regular = typename S::Regular;
  using D = Domain<S::face_kind>;
  using Children = std::array<PatchNode, 4>;

  PatchNode() = default;

  /// The root of a tree: a start patch at `level` splits below its control face. The neighbourhood of an irregular face
  /// is much larger than its patch, so that box is tightened by the children's.
  PatchNode(Patch<S> patch, int level, TreeTotals& totals) : level_(level) {
    set(std::move(patch));
    if (is_regular()) return;
    Box tighter;
    for (const PatchNode& child : children(totals)) tighter.add(child.box());
    box_ = tighter;
  }
  ~PatchNode() { delete children_.load(); }

  bool is_regular() const { return regular_ != nullptr; }
  const Regular& regular() const { return *regular_; }
  const Patch<S>& irregular() const { return *irregular_; }
  const Box& box() const { return box_; }
  int level() const { return level_; }
  /// d(root parameter) / d(parameter): 2^-(splits below the root), negative in a turned triangle.
  double scale() const { return scale_; }

  /// The parameter in the root's domain.
  Parameter to_root(const Parameter& at) const { return origin_ + scale_ * at; }

  /// True for a regular patch flat enough for the finish to take on: its derivatives stay within a quarter of the mean
  /// ones, so that seen from most directions the projection to the ray's frame is one to one. (A smaller share makes
  /// more and flatter patches, a larger one leaves more splitting to each ray.) A degenerate patch never gets there;
  /// beyond eight splits of a polynomial the finish splits on its own.
  bool is_leaf() const { return leaf_; }

  /// The four children, made now if no ray needed them before. Thread-safe; O(points).
  const Children& children(TreeTotals& totals) const {
    if (const Children* known = children_.load(std::memory_order_acquire)) return *known;
    std::unique_ptr<Children> made = split();
    Children* expected = nullptr;
    if (!children_.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
    std::uint64_t bytes = sizeof(Children);
    for (const PatchNode& child : *made) bytes += child.own_bytes();
    totals.bytes += bytes;
    ++totals.patches_split;
    return *made.release();
  }

  std::uint64_t own_bytes() const {
    return regular_ ? sizeof(Regular) : sizeof(Patch<S>) + irregular_->points.capacity() * sizeof(Vec3);
  }

 private:
  static constexpr int deepest_polynomial_split = 8;

  std::unique_ptr<Children> split() const {
    auto children = std::make_unique<Children>();
    std::array<Regular, 4> quarters;
    if (is_regular()) quarters = regular_->split();
    for (std::size_t k = 0; k < 4; ++k) {
      PatchNode& child = (*children)[k];
      child.place(*this, static_cast<int>(k));
      if (is_regular()) {
        child.regular_level_ = regular_level_;
        child.set(quarters[k]);
      } else {
        child.set(irregular_->child(static_cast<int>(k)));
      }
    }
    return children;
  }

  void place(const PatchNode& parent, int k) {
    origin_ = parent.to_root(D::to_parent(k, Parameter::Zero()));
    scale_ = parent.scale_ * D::scale(k);
    level_ = parent.level_ + 1;
  }

  void set(Patch<S> patch) {
    if (patch.is_regular()) {
      regular_level_ = level_;
      return set(patch.regular());
    }
    irregular_ = std::make_unique<Patch<S>>(std::move(patch));
    bound(irregular_->points);
  }

  void set(const Regular& piece) {
    regular_ = std::make_unique<Regular>(piece);
    bound(piece.b);
    leaf_ = level_ - regular_level_ >= deepest_polynomial_split || is_flat(piece);
  }

  /// The control points carry the roundings that RayFrame::error bounds; a box test must not be stricter.
  template <class Points>
  void bound(const Points& points) {
    for (const Vec3& point : points) box_.add(point);
    const double slack = 160 * unit_roundoff * box_.largest_coordinate();
    box_.lower.array() -= slack;
    box_.upper.array() += slack;
  }

  static bool is_flat(const Regular& piece) {
    constexpr double share = 0.25;
    const Vec3 du = piece.mean_du(), dv = piece.mean_dv();
    const double limit_u = share * share * du.squaredNorm(), limit_v = share * share * dv.squaredNorm();
    bool flat = true;
    piece.visit_du([&](const Vec3& d) { flat = flat && (d - du).squaredNorm() <= limit_u; });
    piece.visit_dv([&](const Vec3& d) { flat = flat && (d - dv).squaredNorm() <= limit_v; });
    return flat;
  }

  std::unique_ptr<Regular> regular_;
  std::unique_ptr<Patch<S>> irregular_;
  Box box_;
  Parameter origin_ = Parameter::Zero();
  double scale_ = 1;
  int level_ = 0;
  int regular_level_ = 0;  ///< the level at which the polynomial began
  bool leaf_ = false;
  mutable std::atomic<Children*> children_{nullptr};
};

}  // namespace shaolin
