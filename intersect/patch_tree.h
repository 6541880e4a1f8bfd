#pragma once
/// The patches of one face, split lazily and kept: a node's children are made when a ray first needs them.
#include <atomic>
#include <memory>

#include "../schemes/errors.h"
#include "../schemes/patch.h"
#include "box_space.h"
#include "check_finite.h"
#include "limit_bounds.h"
#include "net.h"
#include "tree_totals.h"

namespace shaolin {

/// A patch with the affine map of its parameters to those of the tree's root. Regular patches hold their polynomial's
/// Bezier points, irregular ones a configuration and control points; either way the limit lies in the points' hull
/// (irregular ones: expanded as their configuration says).
/// Without polynomials a patch is cut until it is nearly flat, at most three levels deep; what is finer is found ray by
/// ray (refining_finish.h), for no ray comes that way again. Whether a patch is a leaf depends on the patch alone, so
/// the tree that rays grow is the same in whatever order they come.
template <Scheme S>
class PatchNode {
 public:
  using Regular = RegularPatch<S::face_kind>;
  using D = Domain<S::face_kind>;
  struct Children;

  PatchNode() = default;

  /// The root of a tree: a start patch at `level` splits below its control face. The neighbourhood of an irregular face
  /// is much larger than its patch, so that box is tightened by the children's.
  PatchNode(Patch<S> patch, int level, const BoxSpace& space, TreeTotals& totals) : level_(level) {
    set(std::move(patch));
    if (is_regular() || leaf_) return;
    const Children& quarters = children(space, totals);
    box_ = Box();
    for (const PatchNode& child : quarters.nodes) box_.add(child.box());
  }
  ~PatchNode();

  bool is_regular() const { return regular_ != nullptr; }
  const Net& regular() const { return *regular_; }
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
  /// beyond five splits of a polynomial the finish splits on its own.
  bool is_leaf() const { return leaf_; }

  /// True for an irregular patch so far down that it may lie within rounding of a ray. (Leaves are none.)
  bool is_tiny() const { return !is_regular() && level_ >= tiny_level; }

  /// The four children, or null if no ray needed them yet.
  const Children* known_children() const { return children_.load(std::memory_order_acquire); }

  /// The four children, made now if no ray needed them before, with boxes for rays in `space`. Thread-safe; O(points).
  const Children& children(const BoxSpace& space, TreeTotals& totals) const;

  std::uint64_t own_bytes() const {
    return regular_ ? sizeof(Net) : sizeof(Patch<S>) + irregular_->points.capacity() * sizeof(Vec3);
  }

 private:
  static constexpr int deepest_polynomial_split = 5;
  static constexpr int deepest_kept_refinement = 3;
  /// From here on an irregular patch may be taken for a point. Not before, even if it is one: whether it is asked there
  /// must not depend on whether its children are known already.
  static constexpr int tiny_level = 24;

  std::unique_ptr<Children> split(const BoxSpace& space) const;

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
    check_finite(irregular_->points);
    box_ = limit_bound(*irregular_).with_rounding();
    leaf_ = basis_of(irregular_->configuration->scheme()) == Basis::none &&
            (level_ >= deepest_kept_refinement || is_flat(*irregular_));
  }

  void set(const Regular& piece) {
    regular_ = std::make_unique<Net>(piece);
    check_finite(piece.b);
    for (const Vec3& point : piece.b) box_.add(point);
    box_ = box_.with_rounding();
    leaf_ = level_ - regular_level_ >= deepest_polynomial_split || is_flat(piece);
  }

  /// The surface adds at most an eighth of its sides to its flat part.
  static bool is_flat(const Patch<S>& patch) {
    const std::optional<FlatPart> part = flat_part(patch);
    if (!part) return false;
    const double side = std::min(part->along_u.norm(), part->along_v.norm());
    return (part->remainder.upper - part->remainder.lower).maxCoeff() <= 0.125 * side;
  }

  static bool is_flat(const Regular& piece) {
    constexpr double share = 0.25;
    const auto stays = [&](const auto& pairs, const Vec3& mean) {
      return std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
        const Vec3 derivative = Regular::degree * (piece.b[pair[1]] - piece.b[pair[0]]);
        return (derivative - mean).squaredNorm() <= share * share * mean.squaredNorm();
      });
    };
    return stays(Regular::u_pairs, Regular::mean_du(piece.b)) && stays(Regular::v_pairs, Regular::mean_dv(piece.b));
  }

  std::unique_ptr<Net> regular_;
  std::unique_ptr<Patch<S>> irregular_;
  Box box_;
  Parameter origin_ = Parameter::Zero();
  double scale_ = 1;
  int level_ = 0;
  int regular_level_ = 0;  ///< the level at which the polynomial began
  bool leaf_ = false;
  mutable std::atomic<Children*> children_{nullptr};
};

/// The four children with their boxes side by side.
template <Scheme S>
struct PatchNode<S>::Children {
  std::array<PatchNode, 4> nodes;
  EightBoxes boxes;  ///< the first four
};

template <Scheme S>
PatchNode<S>::~PatchNode() {
  delete children_.load();
}

template <Scheme S>
auto PatchNode<S>::children(const BoxSpace& space, TreeTotals& totals) const -> const Children& {
  if (const Children* known = known_children()) return *known;
  std::unique_ptr<Children> made = split(space);
  Children* expected = nullptr;
  if (!children_.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  std::uint64_t bytes = sizeof(Children);
  for (const PatchNode& child : made->nodes) bytes += child.own_bytes();
  totals.bytes += bytes;
  ++totals.patches_split;
  return *made.release();
}

template <Scheme S>
auto PatchNode<S>::split(const BoxSpace& space) const -> std::unique_ptr<Children> {
  auto children = std::make_unique<Children>();
  std::array<Regular, 4> quarters;
  std::vector<Patch<S>> patches;
  if (is_regular())
    quarters = regular_->template bezier<Regular>().split();
  else
    patches = irregular_->children();
  for (std::size_t k = 0; k < 4; ++k) {
    PatchNode& child = children->nodes[k];
    child.place(*this, static_cast<int>(k));
    if (is_regular()) {
      child.regular_level_ = regular_level_;
      child.set(quarters[k]);
    } else {
      child.set(std::move(patches[k]));
    }
    children->boxes.set(k, {child.box_, space});
  }
  return children;
}

}  // namespace shaolin
