#pragma once
/// The patches of one face, split lazily and kept: a patch's parts are made when a ray first needs them.
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>
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
  PolynomialPatch(const Polynomial& polynomial, const Place& place, bool is_smooth_across, int halvings = 0)
      : PatchNode<S>(place, true, is_leaf(polynomial, halvings)),
        is_smooth_across_(is_smooth_across),
        halvings_(halvings),
        net_(polynomial) {}

  /// True for a polynomial flat enough for the finish to take on: its derivatives stay within 0.45 of the mean
  /// ones, so that seen from most directions the projection to the ray's frame is one to one. (A smaller share makes
  /// more and flatter pieces, a larger one leaves more splitting to each ray.) A degenerate patch never gets there;
  /// beyond ten halvings the finish splits on its own.
  static bool is_leaf(const Polynomial& polynomial, int halvings);

  /// True where the polynomials beyond all sides and corners are known to continue this one to second order: all its
  /// spline's points are the surface's, with no crease and no irregular vertex next to it.
  bool is_smooth_across() const { return is_smooth_across_; }
  const Net& net() const { return net_; }
  Polynomial polynomial() const { return net_.bezier<Polynomial>(); }
  int halvings() const { return halvings_; }
  Box bound() const override { return hull_of(net_).grown(this->place().rounding); }
  std::uint64_t bytes() const override { return sizeof *this; }

 private:
  bool is_smooth_across_;
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

/// What a patch that is no leaf consists of, with the boxes side by side. Of its parts the largest that is no leaf is
/// taken apart, too, as long as there is room: an irregular patch into patches, or into strips beside a crease, a
/// polynomial into its pieces. So a ray tests up to sixteen boxes at once, and a flat piece needs no memory but its
/// box: its points are made anew for each ray that meets it.
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

  /// A part that may still be taken apart: a patch, or a piece of a polynomial one.
  struct Part {
    const PatchNode<S>* patch;
    Box box;
    bool is_leaf;
    int number = 0;              ///< of the piece, see pieces.h
    Polynomial polynomial = {};  ///< the piece
    int halvings = 0;            ///< that led to it
    bool is_smooth_across = false;
  };

  static Part whole(const PatchNode<S>& patch);
  /// How many parts would take this one's place; 0 if it is to stay.
  static std::size_t count_apart(const Part& part, int deepest);
  /// Takes a part that is no leaf apart: appends its own parts.
  void take_apart(const Part& part, std::vector<Part>& parts);
  void add(const Part& part, const BoxSpace& space);
  const PatchNode<S>& keep(std::unique_ptr<const PatchNode<S>> patch);

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
  return std::make_unique<PolynomialPatch<S>>(polynomial, place, patch.configuration->layout()->is_smooth_across());
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
  // A patch with one irregular corner has 13 parts three levels down. What is deeper fewer rays meet.
  constexpr int levels_at_once = 3;
  const int deepest = patch.place().level() + levels_at_once;
  std::vector<Part> parts;
  parts.reserve(most);
  take_apart(whole(patch), parts);
  for (;;) {
    double largest = -1;
    std::size_t open = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::size_t count = count_apart(parts[i], deepest);
      if (count == 0 || parts.size() - 1 + count > most || parts[i].box.half_area() <= largest) continue;
      largest = parts[i].box.half_area();
      open = i;
    }
    if (open == parts.size()) break;
    const Part part = std::exchange(parts[open], parts.back());
    parts.pop_back();
    take_apart(part, parts);
    if (!part.patch->is_polynomial())
      std::erase_if(patches_, [&](const auto& kept) { return kept.get() == part.patch; });
  }
  for (const Part& part : parts) add(part, space);
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
auto Parts<S>::whole(const PatchNode<S>& patch) -> Part {
  Part part{&patch, patch.bound(), patch.is_leaf()};
  if (patch.is_polynomial() && !part.is_leaf) {
    const auto& polynomial = static_cast<const PolynomialPatch<S>&>(patch);
    part.polynomial = polynomial.polynomial();
    part.halvings = polynomial.halvings();
    part.is_smooth_across = polynomial.is_smooth_across();
  }
  return part;
}

template <Scheme S>
std::size_t Parts<S>::count_apart(const Part& part, int deepest) {
  using Cuts = Pieces<Polynomial>;
  if (part.is_leaf) return 0;
  if (part.patch->is_polynomial()) return Cuts::can_cut(part.polynomial, part.number) ? Cuts::parts : 0;
  if (part.patch->place().level() >= deepest) return 0;
  const Configuration<S>& configuration = *static_cast<const IrregularPatch<S>&>(*part.patch).patch().configuration;
  if (basis_of(configuration.scheme()) == Basis::none) return 0;  // the tree ends three levels down in any case
  if constexpr (S::face_kind == FaceKind::quad)
    if (const auto& strips = configuration.crease_strips()) return strips->count();
  return static_cast<std::size_t>(configuration.child_count());
}

template <Scheme S>
void Parts<S>::take_apart(const Part& part, std::vector<Part>& parts) {
  using Cuts = Pieces<Polynomial>;
  ++splits_;
  const Place& place = part.patch->place();
  if (part.patch->is_polynomial()) {
    const auto cut = Cuts::cut(part.polynomial, part.number);
    const int halvings = part.halvings + static_cast<int>(Cuts::parts) / 2;
    for (std::size_t k = 0; k < Cuts::parts; ++k) {
      const Polynomial& piece = cut.parts[k];
      parts.push_back({part.patch, hull_of(Net(piece)).grown(place.rounding),
                       PolynomialPatch<S>::is_leaf(piece, halvings), cut.numbers[k], piece, halvings,
                       part.is_smooth_across});
    }
    return;
  }
  const Patch<S>& irregular = static_cast<const IrregularPatch<S>&>(*part.patch).patch();
  if constexpr (S::face_kind == FaceKind::quad) {
    if (const auto& strips = irregular.configuration->crease_strips()) {
      for (const auto& [domain, polynomial] : strips->strips(irregular.points.data()))
        parts.push_back(whole(keep(std::make_unique<PolynomialPatch<S>>(polynomial, place.part(domain), false))));
      return;
    }
  }
  std::vector<Patch<S>> children = irregular.children();
  for (std::size_t k = 0; k < children.size(); ++k) {
    const Place child = place.part(child_domain<S::face_kind>(static_cast<int>(k)));
    parts.push_back(whole(keep(PatchNode<S>::make(std::move(children[k]), child))));
  }
}

template <Scheme S>
void Parts<S>::add(const Part& part, const BoxSpace& space) {
  const std::size_t i = count_++;
  assert(i < most);
  if (i == 8) second_ = std::make_unique<Eight>();
  Eight& eight = i < 8 ? first_ : *second_;
  eight.boxes.set(i % 8, {part.box, space});
  eight.patch[i % 8] = part.patch;
  if (part.is_leaf) {
    eight.piece[i % 8] = static_cast<std::int8_t>(part.number);
    return;
  }
  const Place& place = part.patch->place();
  if (part.number != 0)
    eight.patch[i % 8] = &keep(std::make_unique<PolynomialPatch<S>>(
        part.polynomial, place.part(Pieces<Polynomial>::domain(part.number)), part.is_smooth_across, part.halvings));
  // From here on an irregular patch may be taken for a point. Not before, even if it is one: whether it is asked there
  // must not depend on whether its parts are known already.
  constexpr int tiny_level = 24;
  eight.piece[i % 8] = !part.patch->is_polynomial() && place.level() >= tiny_level ? tiny : inner;
}

template <Scheme S>
const PatchNode<S>& Parts<S>::keep(std::unique_ptr<const PatchNode<S>> patch) {
  patches_.push_back(std::move(patch));
  return *patches_.back();
}

}  // namespace shaolin
