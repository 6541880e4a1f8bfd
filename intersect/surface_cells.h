#pragma once
/// The cells of an object of one scheme: through its hierarchy, its start patches and the parts that rays use, too,
/// down to pieces that are made for one query.
#include <functional>

#include "bvh.h"
#include "counters.h"
#include "net_evaluation.h"
#include "parts.h"
#include "patch_budget.h"
#include "squared_distance.h"
#include "surface_cell.h"

namespace shaolin {

/// Where cells come from, for as long as a query takes. The patches that it meets stay until this ends.
template <Scheme S>
struct CellSource {
  /// Whose patch a leaf of the hierarchy stands for.
  struct Leaf {
    int face, sub;
  };
  /// A start patch, and its parts.
  struct Start {
    const PatchNode<S>& patch;
    typename Parts<S>::Slot& parts;
  };

  PatchBudget::Query guard;
  const Bvh& hierarchy;
  TreeTotals& totals;
  std::function<Leaf(int primitive)> leaf;
  std::function<Start(int primitive)> start;

  CellSource(PatchBudget* budget, const Bvh& bvh, TreeTotals& tree_totals, std::function<Leaf(int)> leaves,
             std::function<Start(int)> starts)
      : guard(budget), hierarchy(bvh), totals(tree_totals), leaf(std::move(leaves)), start(std::move(starts)) {}
};

/// The domain of half k of a patch, as the patch's halves().
template <class Bezier>
CellDomain half_domain(int side, int k) {
  if constexpr (Bezier::DomainType::corner_count == 4) {
    SubDomain half;
    half.scale[side] = 0.5;
    half.origin[side] = 0.5 * k;
    return half;
  } else {
    std::array<Parameter, 3> at{Parameter{0, 0}, Parameter{1, 0}, Parameter{0, 1}};
    const auto from = static_cast<std::size_t>(side), to = (from + 1) % 3;
    at[k == 0 ? to : from] = 0.5 * (at[from] + at[to]);
    return {at[0], at[1], at[2]};
  }
}

/// A Bezier patch, or a piece of one: its parts are made for this query.
template <class Bezier>
class PolynomialCell final : public SurfaceCell {
 public:
  PolynomialCell(const Net& net, const Place& place) : SurfaceCell(hull_of(net), place), net_(net) {}

  Vec3 supporting_point(const Vec3& n) const override {
    std::array<double, 16> plane, along;
    combine(n.x(), net_.x, n.y(), net_.y, plane);
    combine(1, plane, n.z(), net_.z, along);
    const std::size_t i = place_of_least(along);
    return {net_.x[i], net_.y[i], net_.z[i]};
  }
  double least_length(const Eigen::Matrix3d& map, const Vec3& offset, const Parameter& at) const override;
  std::optional<CellSample> sample(const Parameter& at) const override {
    const std::array<double, 48> points = by_coordinate(net_);
    const Jet jet = shaolin::jet(SplineWindow<Bezier>(points.data(), 4, RowMap<Bezier>::identity()), at);
    return CellSample{at, jet.position, jet.derivatives};
  }
  bool is_triangular() const override { return Bezier::DomainType::corner_count == 3; }

 private:
  Cells split() const override;
  std::unique_ptr<SurfaceCell> part(const Bezier& piece, const CellDomain& domain) const {
    Place at = place();
    at.domain = at.domain(domain);
    at.level += at.domain.depth() - place().domain.depth();
    return std::make_unique<PolynomialCell>(Net(piece), at);
  }

  Net net_;
};

/// Into halves, across the longest side: one that is collapsed to a curve, as beside a fold, would else have as many
/// cells across the curve as along it, all at one place.
template <class Bezier>
auto PolynomialCell<Bezier>::split() const -> Cells {
  const Bezier patch = net_.bezier<Bezier>();
  double most = -1;
  std::size_t longest = 0;
  for (std::size_t side = 0; side < Bezier::side_pairs.size(); ++side) {
    double length = 0;
    for (const auto& [from, to] : Bezier::side_pairs[side])
      length = std::max(length, (patch.b[to] - patch.b[from]).squaredNorm());
    if (length > most) longest = side;
    most = std::max(most, length);
  }
  const auto halves = patch.halves(static_cast<int>(longest));
  Cells parts;
  for (std::size_t k = 0; k < halves.size(); ++k)
    parts.push_back(part(halves[k], half_domain<Bezier>(static_cast<int>(longest), static_cast<int>(k))));
  return parts;
}

template <class Bezier>
double PolynomialCell<Bezier>::least_length(const Eigen::Matrix3d& map, const Vec3& offset, const Parameter& at) const {
  Bezier image = net_.bezier<Bezier>();
  for (Vec3& point : image.b) point = map * point + offset;
  const Vec3 place = image.position(at);
  const Derivatives d = image.derivatives(at);
  const SquaredDistance<Bezier> all(Net(image), place);
  const Quadratic below{at, {2 * place.dot(d.du), 2 * place.dot(d.dv)}, all.below()};
  const double change = std::max(lowest<typename Bezier::DomainType>(below).change, all.least());
  return std::sqrt(std::max(0.0, place.squaredNorm() + change));
}

/// A patch of a scheme without polynomials, or a piece of one. Where the neighbourhood is a lattice's, the surface is
/// the plane of three corners and a remainder that falls with the square of the cell's size (limit_bounds.h).
template <Scheme S>
class RefinedCell final : public SurfaceCell {
  using D = Domain<S::face_kind>;

 public:
  RefinedCell(Patch<S> patch, const Place& place)
      : SurfaceCell(limit_bound(patch), place), patch_(std::move(patch)), flat_(flat_part(patch_)) {}

  Vec3 supporting_point(const Vec3& n) const override {
    if (!flat_) return SurfaceCell::supporting_point(n);
    Vec3 corner = flat_->corner;
    for (const auto& [u, v] : D::corners)
      if (const Vec3 other = flat_->at({u, v}); n.dot(other) < n.dot(corner)) corner = other;
    return corner + (n.array() > 0).select(flat_->remainder.lower, flat_->remainder.upper).matrix();
  }
  /// Only of the centre, which one split makes a corner. A finer place would take as many splits as it has bits.
  std::optional<CellSample> sample(const Parameter&) const override {
    if (!centre_) centre_ = evaluate(patch_, D::centre(), false).position;
    return CellSample{D::centre(), *centre_, {}};
  }
  bool is_triangular() const override { return D::corner_count == 3; }

 private:
  Cells split() const override {
    Cells parts;
    std::vector<Patch<S>> children = patch_.children();
    for (std::size_t k = 0; k < children.size(); ++k) {
      Place part = place();
      part.domain = part.domain(child_domain<S::face_kind>(static_cast<int>(k)));
      ++part.level;
      parts.push_back(std::make_unique<RefinedCell>(std::move(children[k]), part));
    }
    return parts;
  }

  Patch<S> patch_;
  std::optional<FlatPart> flat_;
  mutable std::optional<Vec3> centre_;  ///< once it was asked for
};

/// An irregular patch that is kept, with the parts that are.
template <Scheme S>
class PatchCell final : public SurfaceCell {
  using D = Domain<S::face_kind>;

 public:
  PatchCell(const CellSource<S>& source, const IrregularPatch<S>& patch, typename Parts<S>::Slot& slot,
            const Place& place)
      : SurfaceCell(hull_bound(patch.patch()), place), source_(source), patch_(patch), slot_(slot) {}

  /// Of the hull of the points, expanded.
  Vec3 supporting_point(const Vec3& n) const override {
    const auto along = [&](const Vec3& a, const Vec3& b) { return n.dot(a) < n.dot(b); };
    const std::vector<Vec3>& points = patch_.patch().points;
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), along);
    const Vec3 of_hull = *low + patch_.patch().configuration->hull_expansion() * (*low - *high);
    return std::max(of_hull, SurfaceCell::supporting_point(n), along);
  }
  /// The corner of the face that the patch is at: around irregular ones patches shrink without end.
  std::optional<CellSample> sample(const Parameter&) const override;
  bool is_triangular() const override { return D::corner_count == 3; }

 private:
  Cells split() const override;

  const CellSource<S>& source_;
  const IrregularPatch<S>& patch_;
  typename Parts<S>::Slot& slot_;
};

/// A node of an object's hierarchy, or a face that it leads to.
template <Scheme S>
class HierarchyCell final : public SurfaceCell {
 public:
  /// The root of a hierarchy that has faces.
  explicit HierarchyCell(std::shared_ptr<const CellSource<S>> source)
      : SurfaceCell(source->hierarchy.bounds(), {}), owned_(std::move(source)), source_(*owned_), child_(0) {}
  HierarchyCell(const CellSource<S>& source, std::int32_t child, const Box& box)
      : SurfaceCell(box, place_of(source, child)), source_(source), child_(child) {}

 private:
  static Place place_of(const CellSource<S>& source, std::int32_t child) {
    Place place;
    if (child >= 0) return place;
    const typename CellSource<S>::Leaf leaf = source.leaf(~child);
    place.face = leaf.face;
    place.sub = leaf.sub;
    return place;
  }
  Cells split() const override;

  std::shared_ptr<const CellSource<S>> owned_;  ///< the root's
  const CellSource<S>& source_;
  std::int32_t child_;  ///< a node of the hierarchy, or ~primitive
};

/// The cell of a patch that is kept: all of it, or a numbered piece of a polynomial.
template <Scheme S>
std::unique_ptr<SurfaceCell> make_cell(const CellSource<S>& source, int face, int sub,
                                       const typename Parts<S>::Part& part) {
  const PatchNode<S>& patch = part.patch;
  using Polynomial = RegularPatch<S::face_kind>;
  const auto place = [&](const Place& at) {
    return SurfaceCell::Place{face, sub, at.domain(), at.level(), at.rounding()};
  };
  if (patch.is_polynomial()) {
    const int number = part.piece;
    const Net whole = static_cast<const PolynomialPatch<S>&>(patch).net();
    Net net;
    pieces_of<Polynomial>.restrict_to(number, whole.x, net.x);
    pieces_of<Polynomial>.restrict_to(number, whole.y, net.y);
    pieces_of<Polynomial>.restrict_to(number, whole.z, net.z);
    return std::make_unique<PolynomialCell<Polynomial>>(net,
                                                        place(patch.place().part(Pieces<Polynomial>::domain(number))));
  }
  const auto& irregular = static_cast<const IrregularPatch<S>&>(patch);
  if (patch.is_leaf()) return std::make_unique<RefinedCell<S>>(irregular.patch(), place(patch.place()));
  return std::make_unique<PatchCell<S>>(source, irregular, *part.parts, place(patch.place()));
}

template <Scheme S>
std::optional<CellSample> PatchCell<S>::sample(const Parameter&) const {
  const Parameter corner = D::nearest(place().domain(D::centre())).array().round();
  for (const auto& [u, v] : D::corners)
    if (corner == place().domain({u, v}))
      return CellSample{{u, v}, evaluate(patch_.patch(), Parameter(u, v), false).position, {}};
  return {};
}

template <Scheme S>
auto PatchCell<S>::split() const -> Cells {
  // As in ClosestSearch.
  constexpr int most_levels = 500;
  if (place().level >= most_levels)
    throw InputError("a patch does not shrink to a point in " + std::to_string(most_levels) +
                     " levels: the masks of the scheme do not converge; see 'shaolin scheme check'");
  using Kept = Parts<S>;
  const Kept& kept = Kept::of(patch_, slot_, source_.hierarchy.space(), source_.totals);
  Cells parts;
  for (std::size_t i = 0; i < kept.count(); ++i)
    parts.push_back(make_cell(source_, place().face, place().sub, kept.part(i)));
  return parts;
}

template <Scheme S>
auto HierarchyCell<S>::split() const -> Cells {
  Cells parts;
  if (child_ >= 0) {
    source_.hierarchy.open(child_, [&](std::int32_t child, const Box& box) {
      parts.push_back(std::make_unique<HierarchyCell>(source_, child, box));
    });
  } else {
    const typename CellSource<S>::Start start = source_.start(~child_);
    parts.push_back(make_cell(source_, place().face, place().sub, {start.patch, 0, &start.parts, false}));
  }
  return parts;
}

}  // namespace shaolin
