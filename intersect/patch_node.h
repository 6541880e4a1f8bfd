#pragma once
/// The patches that trees keep: polynomials, and irregular ones that are split further.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "../schemes/patch.h"
#include "box.h"
#include "check_finite.h"
#include "limit_bounds.h"
#include "net.h"
#include "spline_window.h"

namespace shaolin {

/// Where a patch lies in its tree: which part of the root's domain it is, and what it has from the root.
class Place {
 public:
  Place() = default;
  Place(const SubDomain& domain, int root_level, double rounding)
      : u_(domain.origin.x()),
        v_(domain.origin.y()),
        rounding_(upper_half(rounding)),
        u_halvings_(static_cast<std::uint32_t>(-std::ilogb(domain.scale.x()))),
        v_halvings_(static_cast<std::uint32_t>(-std::ilogb(domain.scale.y()))),
        root_level_(static_cast<std::uint32_t>(root_level)),
        is_turned_(domain.scale.x() < 0) {}

  SubDomain domain() const { return {{u_, v_}, {scale(u_halvings_), scale(v_halvings_)}}; }
  int level() const { return static_cast<int>(root_level_ + std::max<std::uint32_t>(u_halvings_, v_halvings_)); }
  /// Box::rounding() of the root's points, or a little more: a small piece carries the errors of what it was made of.
  double rounding() const { return std::bit_cast<double>(std::uint64_t{rounding_} << 32); }
  Place part(const SubDomain& part) const { return {domain()(part), static_cast<int>(root_level_), rounding()}; }

 private:
  double scale(std::uint32_t halvings) const { return (is_turned_ ? -1 : 1) * negative_power_of_two(halvings); }
  static double negative_power_of_two(std::uint32_t k) { return std::bit_cast<double>(std::uint64_t{1023 - k} << 52); }
  /// Of a double that is not negative, rounded up.
  static std::uint32_t upper_half(double value) {
    return static_cast<std::uint32_t>((std::bit_cast<std::uint64_t>(value) + 0xffffffff) >> 32);
  }

  // There are many: a domain's scale is kept by its exponents. (And its origin without Parameter's alignment.)
  double u_ = 0, v_ = 0;
  std::uint32_t rounding_ = 0;
  std::uint32_t u_halvings_ : 12 = 0, v_halvings_ : 12 = 0, root_level_ : 7 = 0, is_turned_ : 1 = 0;
};

/// A patch that is kept: a PolynomialPatch or an IrregularPatch.
template <Scheme S>
class PatchNode {
 public:
  virtual ~PatchNode() = default;
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
  PatchNode(const PatchNode&) = default;

 private:
  Place place_;
  bool is_polynomial_, is_leaf_;
};

/// A regular patch, or a piece of one; the limit lies in the hull of its Bezier points. Bicubics of one split share the
/// points of their spline, a third of the memory, and Bezier points are made anew for each ray that comes to them.
template <Scheme S>
class PolynomialPatch : public PatchNode<S> {
 public:
  using Polynomial = RegularPatch<S::face_kind>;
  using Window = SplineWindow<Polynomial>;

  /// What so many halvings have left of a polynomial, whose points outlive it. Throws InputError if they are not
  /// finite.
  PolynomialPatch(const Window& window, const Place& place, bool is_smooth_across, int halvings = 0)
      : PatchNode<S>(place, true, is_flat_enough(checked(window), halvings)),
        is_smooth_across_(is_smooth_across),
        halvings_(static_cast<std::int8_t>(halvings)),
        side_(static_cast<std::uint8_t>(window.side())),
        map_(window.to_bezier()),
        first_(window.first()) {}

  /// True for a polynomial flat enough for the finish to take on: its derivatives stay within 0.45 of the mean
  /// ones, so that seen from most directions the projection to the ray's frame is one to one. (A smaller share makes
  /// more and flatter pieces, a larger one leaves more splitting to each ray.) A degenerate patch never gets there;
  /// beyond ten halvings the finish splits on its own.
  static bool is_flat_enough(const Polynomial& polynomial, int halvings);

  /// True where the polynomials beyond all sides and corners are known to continue this one to second order: all its
  /// spline's points are the surface's, with no crease and no irregular vertex next to it.
  bool is_smooth_across() const { return is_smooth_across_; }
  Window window() const { return {first_, side_, map_}; }
  Net net() const { return window().net(); }
  Polynomial polynomial() const { return net().template bezier<Polynomial>(); }
  int halvings() const { return halvings_; }
  Box bound() const override { return hull_of(net()).grown(this->place().rounding()); }
  std::uint64_t bytes() const override { return sizeof *this; }

 private:
  static Polynomial checked(const Window& window) {
    const auto polynomial = window.net().template bezier<Polynomial>();
    check_finite(polynomial.b);
    return polynomial;
  }

  // There are many: the window's parts fit into 56 bytes with the rest.
  bool is_smooth_across_;
  std::int8_t halvings_;
  std::uint8_t side_;
  [[no_unique_address]] RowMap<Polynomial> map_;
  const double* first_;
};

/// Points of a patch's own, sixteen a coordinate. (A base, so that they are there before the patch.)
struct OwnPoints {
  std::array<double, 48> points;
};

/// With Bezier points of its own.
template <Scheme S>
class LonePolynomialPatch final : private OwnPoints, public PolynomialPatch<S> {
  using Polynomial = RegularPatch<S::face_kind>;

 public:
  LonePolynomialPatch(const Polynomial& polynomial, const Place& place, bool is_smooth_across, int halvings = 0)
      : OwnPoints{by_coordinate(Net(polynomial))},
        PolynomialPatch<S>({points.data(), 4, RowMap<Polynomial>::identity()}, place, is_smooth_across, halvings) {}
  LonePolynomialPatch(const LonePolynomialPatch&) = delete;
  std::uint64_t bytes() const override { return sizeof *this; }
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
  Box bound() const override { return limit_bound(patch_).grown(this->place().rounding()); }
  std::uint64_t bytes() const override { return sizeof *this + patch_.points.capacity() * sizeof(Vec3); }

 private:
  static bool is_flat_enough(const Patch<S>& patch, const Place& place);

  Patch<S> patch_;
};

template <Scheme S>
std::unique_ptr<PatchNode<S>> PatchNode<S>::make(Patch<S> patch, const Place& place) {
  if (!patch.is_regular()) return std::make_unique<IrregularPatch<S>>(std::move(patch), place);
  return std::make_unique<LonePolynomialPatch<S>>(patch.regular(), place,
                                                  patch.configuration->layout()->is_smooth_across());
}

template <Scheme S>
bool PolynomialPatch<S>::is_flat_enough(const Polynomial& polynomial, int halvings) {
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
    : PatchNode<S>(place, false, is_flat_enough(patch, place)), patch_(std::move(patch)) {
  check_finite(patch_.points);
}

/// Nearly flat: the surface adds at most an eighth of its sides to its flat part.
template <Scheme S>
bool IrregularPatch<S>::is_flat_enough(const Patch<S>& patch, const Place& place) {
  constexpr int deepest_kept = 3;
  if (basis_of(patch.configuration->scheme()) != Basis::none) return false;
  if (place.level() >= deepest_kept) return true;
  const std::optional<FlatPart> part = flat_part(patch);
  if (!part) return false;
  const double side = std::min(part->along_u.norm(), part->along_v.norm());
  return (part->remainder.upper - part->remainder.lower).maxCoeff() <= 0.125 * side;
}

}  // namespace shaolin
