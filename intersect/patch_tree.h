#pragma once
/// The patches of one face, split lazily and kept: a patch's parts are made when a ray first needs them.
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

#include "../schemes/errors.h"
#include "../schemes/patch.h"
#include "box_space.h"
#include "check_finite.h"
#include "limit_bounds.h"
#include "net.h"
#include "pieces.h"
#include "tree_totals.h"

namespace shaolin {

/// Where a patch lies in its tree: which part of the root's domain it is, and what it has from the root.
struct Place {
  SubDomain domain;
  int root_level = 0;
  double rounding =
      0;  ///< Box::rounding() of the root's points: a small piece carries the errors of what it was made of

  int level() const { return root_level + domain.depth(); }
  Place part(const SubDomain& part) const { return {domain(part), root_level, rounding}; }
};

/// A patch that is kept: a PolynomialPatch or an IrregularPatch.
template <Scheme S>
class PatchNode {
 public:
  virtual ~PatchNode() = default;
  PatchNode(const PatchNode&) = delete;
  PatchNode& operator=(const PatchNode&) = delete;

  /// A start patch, or a child of an irregular one.
  static std::unique_ptr<PatchNode> make(Patch<S> patch, const Place& place);

  bool is_polynomial() const { return is_polynomial_; }
  const Place& place() const { return place_; }

  /// True for a patch that the finish takes on as it is: it has no parts.
  bool is_leaf() const { return is_leaf_; }

  /// A box that holds the limit.
  virtual Box bound() const = 0;
  virtual std::uint64_t bytes() const = 0;

 protected:
  PatchNode(const Place& place, bool is_polynomial, bool is_leaf)
      : place_(place), is_polynomial_(is_polynomial), is_leaf_(is_leaf) {}

 private:
  Place place_;
  bool is_polynomial_, is_leaf_;
};

/// A regular patch, or a piece of one, by its Bezier points; the limit lies in their hull.
template <Scheme S>
class PolynomialPatch final : public PatchNode<S> {
 public:
  using Polynomial = RegularPatch<S::face_kind>;

  /// What so many halvings have left of a polynomial.
  PolynomialPatch(const Polynomial& polynomial, const Place& place, int halvings = 0)
      : PatchNode<S>(place, true, is_leaf(polynomial, halvings)), halvings_(halvings), net_(polynomial) {}

  /// True for a polynomial flat enough for the finish to take on: its derivatives stay within 0.45 of the mean
  /// ones, so that seen from most directions the projection to the ray's frame is one to one. (A smaller share makes
  /// more and flatter pieces, a larger one leaves more splitting to each ray.) A degenerate patch never gets there;
  /// beyond ten halvings the finish splits on its own.
  static bool is_leaf(const Polynomial& polynomial, int halvings);

  const Net& net() const { return net_; }
  Polynomial polynomial() const { return net_.bezier<Polynomial>(); }
  int halvings() const { return halvings_; }
  Box bound() const override { return hull_of(net_).grown(this->place().rounding); }
  std::uint64_t bytes() const override { return sizeof *this; }

 private:
  int halvings_;
  Net net_;
};

/// Any other patch, by configuration and control points; the limit lies in their hull, expanded as the configuration
/// says.
///
/// Without polynomials a patch is cut until it is nearly flat, at most three levels deep; what is finer is found ray by
/// ray (refining_finish.h), for no ray comes that way again.
template <Scheme S>
class IrregularPatch final : public PatchNode<S> {
 public:
  IrregularPatch(Patch<S> patch, const Place& place);

  const Patch<S>& patch() const { return patch_; }
  Box bound() const override { return limit_bound(patch_).grown(this->place().rounding); }
  std::uint64_t bytes() const override { return sizeof *this + patch_.points.capacity() * sizeof(Vec3); }

 private:
  static bool is_leaf(const Patch<S>& patch, const Place& place);

  Patch<S> patch_;
};

/// What a patch that is no leaf consists of, with the boxes side by side. Those of a polynomial are its pieces. An
/// irregular patch is split into patches, or into strips beside a crease, and polynomials among them go on into their
/// pieces. So a ray tests up to sixteen boxes at once, and a flat piece needs no memory but its box: its points are
/// made anew for each ray that meets it.
///
/// How a patch is split depends on the patch alone, so the tree that rays grow is the same in whatever order they come.
template <Scheme S>
class Parts {
 public:
  using Polynomial = RegularPatch<S::face_kind>;
  /// The parts of a part that has any, once a ray has asked for them.
  using Slot = std::atomic<const Parts*>;

  /// Splits a patch.
  Parts(const PatchNode<S>& patch, const BoxSpace& space);
  ~Parts();

  /// What `slot` holds for a patch, made now if no ray needed it before. Thread-safe. O(control points).
  static const Parts& of(const PatchNode<S>& patch, Slot& slot, const BoxSpace& space, TreeTotals& totals);

  /// Up to eight parts.
  struct Eight {
    EightBoxes boxes;
    /// A leaf's polynomial or irregular patch, or the patch that has parts.
    std::array<const PatchNode<S>*, 8> patch;
    mutable std::array<Slot, 8> parts{};
    /// Of a leaf: which piece of its polynomial, see pieces.h; of other parts `inner`, or `tiny`: these may lie within
    /// rounding of a ray.
    std::array<std::int8_t, 8> piece;
  };
  static constexpr std::int8_t inner = -1, tiny = -2;

  /// Those of the first eight parts that a ray meets, and of the others, each front to back.
  const Eight& first() const { return first_; }
  const Eight* second() const { return second_.get(); }

  /// A box of all boxes.
  SceneBox bound() const;
  /// Patches and pieces that were split.
  int splits() const { return splits_; }
  /// Without parts of parts; and of a slot, with all that there are.
  std::uint64_t bytes() const;
  static std::uint64_t bytes_in(const Slot& slot);

 private:
  static constexpr std::size_t most = 16;

  void add(const PatchNode<S>& patch, std::int8_t piece, const Box& box, const BoxSpace& space);
  const PatchNode<S>& keep(std::unique_ptr<const PatchNode<S>> patch);
  /// The patch as it is or, of a polynomial that is no leaf, its pieces, as many as there is room for.
  void add_patch(const PatchNode<S>& patch, std::size_t room, const BoxSpace& space);
  void cut(const Polynomial& piece, int number, const PolynomialPatch<S>& of, int halvings, std::size_t room,
           const BoxSpace& space);

  Eight first_;
  std::unique_ptr<Eight> second_;
  std::vector<std::unique_ptr<const PatchNode<S>>> patches_;
  std::uint8_t count_ = 0, splits_ = 0;
};

template <Scheme S>
std::unique_ptr<PatchNode<S>> PatchNode<S>::make(Patch<S> patch, const Place& place) {
  if (!patch.is_regular()) return std::make_unique<IrregularPatch<S>>(std::move(patch), place);
  const auto polynomial = patch.regular();
  check_finite(polynomial.b);
  return std::make_unique<PolynomialPatch<S>>(polynomial, place);
}

template <Scheme S>
bool PolynomialPatch<S>::is_leaf(const Polynomial& polynomial, int halvings) {
  constexpr int most_halvings = 10;
  constexpr double share = 0.45;
  const auto stays = [&](const auto& pairs, const Vec3& mean) {
    return std::all_of(pairs.begin(), pairs.end(), [&](const auto& pair) {
      const Vec3 derivative = Polynomial::degree * (polynomial.b[pair[1]] - polynomial.b[pair[0]]);
      return (derivative - mean).squaredNorm() <= share * share * mean.squaredNorm();
    });
  };
  return halvings >= most_halvings || (stays(Polynomial::u_pairs, Polynomial::mean_du(polynomial.b)) &&
                                       stays(Polynomial::v_pairs, Polynomial::mean_dv(polynomial.b)));
}

template <Scheme S>
IrregularPatch<S>::IrregularPatch(Patch<S> patch, const Place& place)
    : PatchNode<S>(place, false, is_leaf(patch, place)), patch_(std::move(patch)) {
  check_finite(patch_.points);
}

/// Nearly flat: the surface adds at most an eighth of its sides to its flat part.
template <Scheme S>
bool IrregularPatch<S>::is_leaf(const Patch<S>& patch, const Place& place) {
  constexpr int deepest_kept = 3;
  if (basis_of(patch.configuration->scheme()) != Basis::none) return false;
  if (place.level() >= deepest_kept) return true;
  const std::optional<FlatPart> part = flat_part(patch);
  if (!part) return false;
  const double side = std::min(part->along_u.norm(), part->along_v.norm());
  return (part->remainder.upper - part->remainder.lower).maxCoeff() <= 0.125 * side;
}

template <Scheme S>
Parts<S>::Parts(const PatchNode<S>& patch, const BoxSpace& space) {
  if (patch.is_polynomial()) {
    const auto& whole = static_cast<const PolynomialPatch<S>&>(patch);
    cut(whole.polynomial(), 0, whole, whole.halvings(), most, space);
  } else {
    ++splits_;
    const Patch<S>& irregular = static_cast<const IrregularPatch<S>&>(patch).patch();
    if constexpr (S::face_kind == FaceKind::quad) {
      if (const auto& strips = irregular.configuration->crease_strips())
        for (const auto& [domain, polynomial] : strips->strips(irregular.points.data()))
          keep(std::make_unique<PolynomialPatch<S>>(polynomial, patch.place().part(domain)));
    }
    if (patches_.empty()) {
      std::vector<Patch<S>> children = irregular.children();
      for (std::size_t k = 0; k < children.size(); ++k)
        keep(PatchNode<S>::make(std::move(children[k]),
                                patch.place().part(child_domain<S::face_kind>(static_cast<int>(k)))));
    }
    const std::size_t count = patches_.size();
    for (std::size_t i = 0; i < count; ++i) add_patch(*patches_[i], most / count, space);
  }
  patches_.shrink_to_fit();
}

template <Scheme S>
Parts<S>::~Parts() {
  for (const Eight* eight : {static_cast<const Eight*>(&first_), static_cast<const Eight*>(second_.get())})
    if (eight)
      for (const Slot& slot : eight->parts) delete slot.load();
}

template <Scheme S>
auto Parts<S>::of(const PatchNode<S>& patch, Slot& slot, const BoxSpace& space, TreeTotals& totals) -> const Parts& {
  if (const Parts* known = slot.load(std::memory_order_acquire)) return *known;
  auto made = std::make_unique<Parts>(patch, space);
  const Parts* expected = nullptr;
  if (!slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) return *expected;
  totals.bytes += made->bytes();
  totals.patches_split += static_cast<std::uint64_t>(made->splits());
  return *made.release();
}

template <Scheme S>
SceneBox Parts<S>::bound() const {
  SceneBox all = first_.boxes.bound();
  if (second_) all.add(second_->boxes.bound());
  return all;
}

template <Scheme S>
std::uint64_t Parts<S>::bytes() const {
  std::uint64_t sum = sizeof *this + (second_ ? sizeof(Eight) : 0) + patches_.capacity() * sizeof(patches_[0]);
  for (const auto& patch : patches_) sum += patch->bytes();
  return sum;
}

template <Scheme S>
std::uint64_t Parts<S>::bytes_in(const Slot& slot) {
  const Parts* const parts = slot.load(std::memory_order_acquire);
  if (!parts) return 0;
  std::uint64_t sum = parts->bytes();
  for (const Eight* eight : {&parts->first_, static_cast<const Eight*>(parts->second_.get())})
    if (eight)
      for (const Slot& below : eight->parts) sum += bytes_in(below);
  return sum;
}

template <Scheme S>
void Parts<S>::add(const PatchNode<S>& patch, std::int8_t piece, const Box& box, const BoxSpace& space) {
  const std::size_t i = count_++;
  assert(i < most);
  if (i == 8) second_ = std::make_unique<Eight>();
  Eight& eight = i < 8 ? first_ : *second_;
  eight.boxes.set(i % 8, {box, space});
  eight.patch[i % 8] = &patch;
  eight.piece[i % 8] = piece;
}

template <Scheme S>
const PatchNode<S>& Parts<S>::keep(std::unique_ptr<const PatchNode<S>> patch) {
  patches_.push_back(std::move(patch));
  return *patches_.back();
}

template <Scheme S>
void Parts<S>::add_patch(const PatchNode<S>& patch, std::size_t room, const BoxSpace& space) {
  if (patch.is_polynomial() && !patch.is_leaf() && room >= Pieces<Polynomial>::parts) {
    const auto& whole = static_cast<const PolynomialPatch<S>&>(patch);
    cut(whole.polynomial(), 0, whole, whole.halvings(), room, space);
  } else {
    // From here on an irregular patch may be taken for a point. Not before, even if it is one: whether it is asked
    // there must not depend on whether its parts are known already.
    constexpr int tiny_level = 24;
    const bool is_tiny = !patch.is_polynomial() && patch.place().level() >= tiny_level;
    add(patch, patch.is_leaf() ? std::int8_t{0} : is_tiny ? tiny : inner, patch.bound(), space);
  }
}

template <Scheme S>
void Parts<S>::cut(const Polynomial& piece, int number, const PolynomialPatch<S>& of, int halvings, std::size_t room,
                   const BoxSpace& space) {
  using Cuts = Pieces<Polynomial>;
  ++splits_;
  const auto made = Cuts::cut(piece, number);
  halvings += static_cast<int>(Cuts::parts) / 2;
  room /= Cuts::parts;
  for (std::size_t k = 0; k < Cuts::parts; ++k) {
    const Polynomial& part = made.parts[k];
    const int at = made.numbers[k];
    const bool leaf = PolynomialPatch<S>::is_leaf(part, halvings);
    if (!leaf && room >= Cuts::parts && Cuts::can_cut(part, at)) {
      cut(part, at, of, halvings, room, space);
      continue;
    }
    const Box box = hull_of(Net(part)).grown(of.place().rounding);
    if (leaf)
      add(of, static_cast<std::int8_t>(at), box, space);
    else
      add(keep(std::make_unique<PolynomialPatch<S>>(part, of.place().part(Cuts::domain(at)), halvings)), inner, box,
          space);
  }
}

}  // namespace shaolin
