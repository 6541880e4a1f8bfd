#pragma once
/// The patches of one face, split lazily and kept: a patch's parts are made when a ray first needs them.
#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "box_space.h"
#include "patch_node.h"
#include "pieces.h"
#include "tree_totals.h"
#include "variation.h"

namespace shaolin {

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
  using Window = SplineWindow<Polynomial>;
  /// The parts of a part that has any, once a ray has asked for them.
  using Slot = std::atomic<const Parts*>;

  /// Splits a patch.
  Parts(const PatchNode<S>& patch, const BoxSpace& space);
  ~Parts();

  /// What `slot` holds for a patch, made now if no ray needed it before. Thread-safe. O(control points).
  static const Parts& of(const PatchNode<S>& patch, Slot& slot, const BoxSpace& space, TreeTotals& totals);

  struct Part {
    const PatchNode<S>& patch;
    int piece;                             ///< of a leaf's polynomial, see pieces.h
    Slot* parts;                           ///< null for a leaf
    bool is_tiny;                          ///< it may lie within rounding of a ray
    const Variation* variation = nullptr;  ///< of a leaf's derivatives
  };

  /// Boxes of the first eight parts, and of the others: a ray asks for those that it meets, front to back.
  const EightBoxes& first() const { return first_.boxes; }
  const EightBoxes* second() const { return second_ ? &second_->boxes : nullptr; }
  std::size_t count() const { return count_; }
  /// The one in a box; the second eight count from 8.
  Part part(std::size_t box) const {
    const Group& group = box < 8 ? first_ : *second_;
    const std::size_t i = box % 8, number = group.patch[i];
    const PatchNode<S>& patch = number < polynomials_.size() ? static_cast<const PatchNode<S>&>(polynomials_[number])
                                                             : *irregular_[number - polynomials_.size()];
    const int piece = group.piece[i];
    if (piece >= 0) return {patch, piece, nullptr, false, &group.variation[i]};
    return {patch, 0, &slots_[static_cast<std::size_t>((-1 - piece) % most)], piece <= first_tiny};
  }

  /// A box of all boxes.
  SceneBox bound() const;
  /// Patches and pieces that were split.
  int splits() const { return splits_; }
  /// Without parts of parts; and of a slot, with all that there are.
  std::uint64_t bytes() const;
  static std::uint64_t bytes_in(const Slot& slot);

 private:
  static constexpr int most = 16;
  static constexpr int first_tiny = -1 - most;

  /// Eight parts side by side: of each its box, the number of its patch, polynomials first, and of a leaf the piece of
  /// it and how its derivatives vary; of others -1 - slot, and 16 less if it is tiny.
  struct Group {
    EightBoxes boxes;
    std::array<Variation, 8> variation;
    std::array<std::uint8_t, 8> patch;
    std::array<std::int8_t, 8> piece;
  };

  /// A part in the making, which may still be taken apart: an irregular patch, or a piece of a polynomial.
  struct Draft {
    const IrregularPatch<S>* irregular;  ///< null for a piece
    Box box;
    bool is_leaf;
    std::size_t index = 0;       ///< of the piece's patch among polynomials_
    int number = 0;              ///< of the piece, see pieces.h
    Polynomial polynomial = {};  ///< the piece
    int halvings = 0;            ///< that led to it
  };

  /// How many parts would take this one's place; 0 if it is to stay.
  std::size_t count_apart(const Draft& part, int deepest) const;
  /// Takes a part that is no leaf apart: appends its own parts.
  void take_apart(const Draft& part, std::vector<Draft>& parts);
  void take_pieces(const Draft& part, std::vector<Draft>& parts);
  void take_children(const IrregularPatch<S>& patch, std::vector<Draft>& parts);
  /// Sets the windows of those children that have their spline's points in common.
  void share(const std::vector<Patch<S>>& children, std::vector<std::optional<Window>>& windows);
  void take_strips(const IrregularPatch<S>& patch, const CreaseStrips& strips, std::vector<Draft>& parts);
  void add(const Draft& part, const BoxSpace& space);

  Draft keep(const PolynomialPatch<S>& patch);
  static Draft whole(const IrregularPatch<S>& patch) { return {&patch, patch.bound(), patch.is_leaf()}; }
  /// A piece as a patch of its own.
  Draft as_patch(const Draft& piece);
  const double* keep(const Net& net) { return keep(by_coordinate(net)); }
  template <std::size_t size>
  const double* keep(const std::array<double, size>& points);

  std::vector<PolynomialPatch<S>> polynomials_;
  std::vector<std::unique_ptr<const IrregularPatch<S>>> irregular_;
  std::vector<std::unique_ptr<const double[]>> points_;  ///< of polynomials
  std::unique_ptr<Slot[]> slots_;
  std::unique_ptr<Group> second_;
  std::uint16_t point_count_ = 0;  ///< of doubles
  std::uint8_t count_ = 0, slot_count_ = 0, splits_ = 0;
  Group first_;
};

template <Scheme S>
Parts<S>::Parts(const PatchNode<S>& patch, const BoxSpace& space) {
  // A patch with one irregular corner has 13 parts three levels down, and 7 two levels down. What is deeper fewer rays
  // meet.
  const int levels_at_once = patch.place().domain().depth() == 0 ? 3 : 2;
  const int deepest = patch.place().level() + levels_at_once;
  std::vector<Draft> parts;
  parts.reserve(most);
  take_apart(patch.is_polynomial() ? keep(static_cast<const PolynomialPatch<S>&>(patch))
                                   : whole(static_cast<const IrregularPatch<S>&>(patch)),
             parts);
  for (;;) {
    double largest = -1;
    std::size_t open = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::size_t count = count_apart(parts[i], deepest);
      if (count == 0 || parts.size() - 1 + count > std::size_t{most} || parts[i].box.half_area() <= largest) continue;
      largest = parts[i].box.half_area();
      open = i;
    }
    if (open == parts.size()) break;
    const Draft part = std::exchange(parts[open], parts.back());
    parts.pop_back();
    take_apart(part, parts);
    if (part.irregular) std::erase_if(irregular_, [&](const auto& kept) { return kept.get() == part.irregular; });
  }
  for (Draft& part : parts)
    if (!part.is_leaf && part.number != 0) part = as_patch(part);
  polynomials_.shrink_to_fit();
  irregular_.shrink_to_fit();
  points_.shrink_to_fit();
  const auto is_inner = [](const Draft& part) { return !part.is_leaf; };
  slots_ = std::make_unique<Slot[]>(static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), is_inner)));
  for (const Draft& part : parts) add(part, space);
}

template <Scheme S>
Parts<S>::~Parts() {
  for (std::size_t i = 0; i < slot_count_; ++i) delete slots_[i].load();
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
  SceneBox all = first().bound();
  if (second_) all.add(second()->bound());
  return all;
}

template <Scheme S>
std::uint64_t Parts<S>::bytes() const {
  std::uint64_t sum = sizeof *this + (second_ ? sizeof *second_ : 0) + slot_count_ * sizeof(Slot) +
                      points_.capacity() * sizeof(points_[0]) + point_count_ * sizeof(double) +
                      polynomials_.capacity() * sizeof(polynomials_[0]) + irregular_.capacity() * sizeof(irregular_[0]);
  for (const auto& patch : irregular_) sum += patch->bytes();
  return sum;
}

template <Scheme S>
std::uint64_t Parts<S>::bytes_in(const Slot& slot) {
  const Parts* const parts = slot.load(std::memory_order_acquire);
  if (!parts) return 0;
  std::uint64_t sum = parts->bytes();
  for (std::size_t i = 0; i < parts->slot_count_; ++i) sum += bytes_in(parts->slots_[i]);
  return sum;
}

template <Scheme S>
std::size_t Parts<S>::count_apart(const Draft& part, int deepest) const {
  using Cuts = Pieces<Polynomial>;
  if (part.is_leaf) return 0;
  if (!part.irregular) return Cuts::can_cut(part.polynomial, part.number) ? Cuts::parts : 0;
  if (part.irregular->place().level() >= deepest) return 0;
  const Configuration<S>& configuration = *part.irregular->patch().configuration;
  if (basis_of(configuration.scheme()) == Basis::none) return 0;  // the tree ends three levels down in any case
  if constexpr (S::face_kind == FaceKind::quad)
    if (const auto& strips = configuration.crease_strips()) return strips->strips().size();
  return static_cast<std::size_t>(configuration.child_count());
}

template <Scheme S>
void Parts<S>::take_apart(const Draft& part, std::vector<Draft>& parts) {
  ++splits_;
  if (!part.irregular) return take_pieces(part, parts);
  if constexpr (S::face_kind == FaceKind::quad)
    if (const auto& strips = part.irregular->patch().configuration->crease_strips())
      return take_strips(*part.irregular, *strips, parts);
  take_children(*part.irregular, parts);
}

template <Scheme S>
void Parts<S>::take_pieces(const Draft& part, std::vector<Draft>& parts) {
  using Cuts = Pieces<Polynomial>;
  const auto cut = Cuts::cut(part.polynomial, part.number);
  const int halvings = part.halvings + static_cast<int>(Cuts::parts) / 2;
  const double rounding = polynomials_[part.index].place().rounding();
  for (std::size_t k = 0; k < Cuts::parts; ++k) {
    const Polynomial& piece = cut.parts[k];
    parts.push_back({nullptr, hull_of(Net(piece)).grown(rounding), PolynomialPatch<S>::is_flat_enough(piece, halvings),
                     part.index, cut.numbers[k], piece, halvings});
  }
}

template <Scheme S>
void Parts<S>::take_strips(const IrregularPatch<S>& patch, const CreaseStrips& strips, std::vector<Draft>& parts) {
  BezierQuad grid;
  grid.b = strips.grid(patch.patch().points.data());
  const double* const points = keep(Net(grid));
  for (const CreaseStrips::Strip& strip : strips.strips())
    parts.push_back(keep({{points, 4, strip.maps}, patch.place().part(strip.domain), false}));
}

template <Scheme S>
void Parts<S>::take_children(const IrregularPatch<S>& patch, std::vector<Draft>& parts) {
  std::vector<Patch<S>> children = patch.patch().children();
  std::vector<std::optional<Window>> windows(children.size());
  if constexpr (S::face_kind == FaceKind::quad) share(children, windows);
  for (std::size_t k = 0; k < children.size(); ++k) {
    const Place place = patch.place().part(child_domain<S::face_kind>(static_cast<int>(k)));
    if (const auto& layout = children[k].configuration->layout()) {
      if (!windows[k]) windows[k].emplace(keep(Net(children[k].regular())), 4, RowMap<Polynomial>::identity());
      parts.push_back(keep({*windows[k], place, layout->is_smooth_across()}));
    } else {
      irregular_.push_back(std::make_unique<IrregularPatch<S>>(std::move(children[k]), place));
      parts.push_back(whole(*irregular_.back()));
    }
  }
}

/// The window of the child at a corner begins there in the lattice of all children.
template <Scheme S>
void Parts<S>::share(const std::vector<Patch<S>>& children, std::vector<std::optional<Window>>& windows) {
  SplineGrid grid;
  std::array<std::optional<std::size_t>, 4> first;
  for (std::size_t k = 0; k < first.size() && children.size() == first.size(); ++k) {
    const auto& layout = children[k].configuration->layout();
    if (!layout || layout->basis != Basis::spline) continue;
    const auto [u, v] = Domain<S::face_kind>::corners[k];
    const auto place = static_cast<std::size_t>(u) + SplineGrid::side * static_cast<std::size_t>(v);
    if (grid.add(layout->spline(children[k].points.data()), place)) first[k] = place;
  }
  if (std::count(first.begin(), first.end(), std::nullopt) > 2) return;
  const double* const points = keep(grid.coordinates());
  for (std::size_t k = 0; k < first.size(); ++k)
    if (first[k]) windows[k].emplace(points + *first[k], SplineGrid::side, RowMap<Polynomial>::of_spline());
}

template <Scheme S>
void Parts<S>::add(const Draft& part, const BoxSpace& space) {
  const std::size_t i = count_++;
  assert(i < most);
  if (i == 8) second_ = std::make_unique<Group>();
  Group& group = i < 8 ? first_ : *second_;
  group.boxes.set(i % 8, {part.box, space});
  const auto is_part = [&](const auto& patch) { return patch.get() == part.irregular; };
  const auto at = std::find_if(irregular_.begin(), irregular_.end(), is_part) - irregular_.begin();
  const std::size_t number = part.irregular ? polynomials_.size() + static_cast<std::size_t>(at) : part.index;
  assert(number <= std::numeric_limits<std::uint8_t>::max());
  group.patch[i % 8] = static_cast<std::uint8_t>(number);
  if (part.is_leaf) {
    group.piece[i % 8] = static_cast<std::int8_t>(part.number);
    if (!part.irregular) group.variation[i % 8] = Variation::of<Polynomial>(Net(part.polynomial));
    return;
  }
  // From here on an irregular patch may be taken for a point. Not before, even if it is one: whether it is asked there
  // must not depend on whether its parts are known already.
  constexpr int tiny_level = 24;
  const bool is_tiny = part.irregular && part.irregular->place().level() >= tiny_level;
  group.piece[i % 8] = static_cast<std::int8_t>((is_tiny ? first_tiny : -1) - slot_count_++);
}

template <Scheme S>
auto Parts<S>::keep(const PolynomialPatch<S>& patch) -> Draft {
  polynomials_.push_back(patch);
  const Net net = patch.net();
  return {nullptr,
          hull_of(net).grown(patch.place().rounding()),
          patch.is_leaf(),
          polynomials_.size() - 1,
          0,
          net.bezier<Polynomial>(),
          patch.halvings()};
}

template <Scheme S>
auto Parts<S>::as_patch(const Draft& piece) -> Draft {
  const PolynomialPatch<S>& whole = polynomials_[piece.index];
  return keep({{keep(Net(piece.polynomial)), 4, RowMap<Polynomial>::identity()},
               whole.place().part(Pieces<Polynomial>::domain(piece.number)),
               whole.is_smooth_across(),
               piece.halvings});
}

template <Scheme S>
template <std::size_t size>
const double* Parts<S>::keep(const std::array<double, size>& points) {
  auto kept = std::make_unique<double[]>(size);
  std::copy(points.begin(), points.end(), kept.get());
  point_count_ = static_cast<std::uint16_t>(point_count_ + size);
  points_.push_back(std::move(kept));
  return points_.back().get();
}

}  // namespace shaolin
