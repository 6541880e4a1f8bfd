#pragma once
/// The exact finish: patches are split until a Newton iteration on the limit surface is safe. It goes beyond the paper:
/// hits are on the limit surface to rounding error, so no gap polygon and no W-case can arise.
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "../schemes/mesh.h"
#include "../schemes/scheme_surface.h"
#include "approach.h"
#include "flat_finish.h"
#include "flatten.h"
#include "newton_finish.h"
#include "parts.h"
#include "ray_frame.h"
#include "refining_finish.h"

namespace shaolin {

/// A Finish of ShaoLin (see shaolin.h). Patches are dropped on proof only: by their boxes, and by the hulls of their
/// control points against RP and CP, which hold the limit.
template <Scheme S>
class ExactFinish {
  using Polynomial = RegularPatch<S::face_kind>;
  using D = Domain<S::face_kind>;

 public:
  /// The patch of a face, or of an n-gon's corner, its own box, which is tighter than the face's in the hierarchy, and
  /// the normal of its plane TP. The neighbourhood of an irregular face is much larger than its patch, so its box is
  /// that of its parts.
  class alignas(64) StartPatch {
   public:
    StartPatch(Patch<S> patch, int level, const BoxSpace& space, const ExactFinish&, TreeTotals& totals)
        : normal_(plane_normal(patch)), reach_(hull_of(patch.points)) {
      patch_ = PatchNode<S>::make(std::move(patch), Place{{}, level, reach_.rounding()});
      is_leaf_ = patch_->is_leaf();
      if (is_leaf_ && patch_->is_polynomial()) variation_ = Variation::of<Polynomial>(polynomial_of(*patch_).net());
      box_ = is_leaf_ || patch_->is_polynomial() ? SceneBox(patch_->bound(), space)
                                                 : Parts<S>::of(*patch_, parts_, space, totals).bound();
    }
    ~StartPatch() { delete parts_.load(); }
    StartPatch(const StartPatch&) = delete;
    StartPatch& operator=(const StartPatch&) = delete;

    const SceneBox& box() const { return box_; }
    const PatchNode<S>& patch() const { return *patch_; }
    bool is_leaf() const { return is_leaf_; }
    /// Of a leaf.
    const Variation& variation() const { return variation_; }
    typename Parts<S>::Slot& parts() const { return parts_; }
    const Vec3& normal() const { return normal_; }
    /// A box of the control points.
    const Box& reach() const { return reach_; }
    std::uint64_t bytes() const { return patch_->bytes(); }
    std::uint64_t grown_bytes() const { return Parts<S>::bytes_in(parts_); }

   private:
    /// Of the plane TP, here through the face's corners, not their limit points: any plane does that a flat patch is
    /// nearly parallel to, and limits take masks. Zero if the corners span none.
    static Vec3 plane_normal(const Patch<S>& patch) {
      using Base = std::conditional_t<S::face_kind == FaceKind::triangle, TriangleMesh, QuadMesh>;
      std::vector<Vec3> corners;
      const FaceSides& face = patch.configuration->neighbourhood().face;  // it may repeat a vertex
      for (int k = 0; k < face.size(); ++k) corners.push_back(patch.points[static_cast<std::size_t>(face.vertex(k))]);
      return Base::chord_normal(corners);
    }

    // What every ray reads that reaches the patch comes first, in one cache line.
    SceneBox box_;
    bool is_leaf_ = false;
    Variation variation_;
    mutable typename Parts<S>::Slot parts_{nullptr};
    std::unique_ptr<const PatchNode<S>> patch_;
    Vec3 normal_;
    Box reach_;
  };

  /// A place in a patch's parameters, met at a distance along the ray, and the piece that met it (see pieces.h).
  struct Found {
    const PatchNode<S>* patch;
    Parameter at;
    int piece;
    double distance;
    double reach = 0;                               ///< see PatchHit
    bool is_proven = false;                         ///< see PatchHit
    Parameter radius = PatchHit::nothing_proven();  ///< see PatchHit
    double error = 0;                               ///< of coordinates in the ray's frame

    /// See certificate.h. Across a side of the face there may be none that has a limit.
    bool is_certified(const SchemeSurface<S>& surface) const {
      const double largest = radius.maxCoeff();
      if (!(largest < 1) || !patch->is_polynomial()) return false;
      if (D::contains(at, radius)) return true;
      if (!(largest <= smooth_radius && polynomial_of(*patch).is_smooth_across())) return false;
      if (surface.mesh().all_have_limit()) return true;
      const SubDomain& domain = patch->place().domain();
      return D::contains(domain(at), domain.scale.cwiseAbs().cwiseProduct(radius));
    }
  };

  template <Query query>
  bool search(const StartPatch& start, Approach& approach, TreeTotals& totals, std::optional<Found>& found) const {
    Search search(start, approach, totals, &found, nullptr);
    search.template run<query>();
    return search.is_found();
  }

  /// Appends all hits. Those at edges of patches and pieces may be there more than once.
  void search_all(const StartPatch& start, Approach& approach, TreeTotals& totals, std::vector<Found>& found) const {
    Search search(start, approach, totals, nullptr, &found);
    search.template run<Query::all>();
  }

  Hit hit(const Found& found, int face, int sub, const SchemeSurface<S>& surface) const {
    const Parameter at = D::nearest(found.patch->place().domain()(found.at));
    Hit hit;
    hit.at = {face, sub, at.x(), at.y()};
    hit.level = found.patch->place().part(Pieces<Polynomial>::domain(found.piece)).level();
    if (!found.patch->is_polynomial()) {
      hit.sample = *surface.evaluate(hit.at);
      return hit;
    }
    const Jet jet = this->jet(found);
    hit.sample = sample(*found.patch, jet, hit.at, surface);
    if (found.is_certified(surface)) hit.certificate = {Certificate::Status::certified, 0, position_error(found, jet)};
    return hit;
  }

 private:
  /// A ray on its way through one start patch.
  class Search {
   public:
    /// What it finds goes to `nearest`, or to `all`: the other is null.
    Search(const StartPatch& start, Approach& approach, TreeTotals& totals, std::optional<Found>* nearest,
           std::vector<Found>* all)
        : start_(start),
          approach_(approach),
          totals_(totals),
          nearest_(nearest),
          all_(all),
          error_(RayFrame::error(approach.ray.origin, start.reach())) {}

    template <Query query>
    void run() {
      any_ = query == Query::any;
      if (start_.is_leaf())
        finish(start_.patch(), 0, start_.variation());
      else
        descend<query>(start_.patch(), start_.parts());
    }

    /// Through the parts of a patch.
    template <Query query>
    void descend(const PatchNode<S>& patch, typename Parts<S>::Slot& slot, bool is_tiny = false);
    /// At a leaf: a piece of a polynomial, or a patch without one.
    void finish(const PatchNode<S>& patch, int piece, const Variation& variation);

    bool is_found() const { return is_found_; }

   private:
    bool may_meet(const PatchNode<S>& patch, bool is_tiny);
    bool may_meet(const Box& hull) const {
      const Vec3 &low = hull.lower, &high = hull.upper;
      return low.x() <= 2 * error_ && high.x() >= -2 * error_ && low.y() <= 2 * error_ && high.y() >= -2 * error_;
    }
    bool project(const SplineWindow<Polynomial>& patch, int number, Net& piece);
    void finish_by_refinement(const IrregularPatch<S>& patch);
    void finish_as_point(const PatchNode<S>& patch, const Patch<S>& irregular, const Box& hull);

    /// The ray's frame, made when a patch first asks: most rays miss the boxes of most patches.
    const RayFrame& frame() {
      if (!frame_) frame_.emplace(approach_.ray, start_.normal());
      return *frame_;
    }

    /// The nearest hit so far, in the patch's parameters, or one of all.
    void take(const PatchNode<S>& patch, const PatchHit& hit, int piece) {
      const Found taken{&patch, hit.at, piece, hit.distance, hit.reach, hit.is_proven, hit.radius, error_};
      if (all_) return all_->push_back(taken);
      *nearest_ = taken;
      is_found_ = true;
      approach_.shorten(hit.distance);
    }
    /// What a solver finds, the nearest or all.
    template <class Solver, class Piece, class Take>
    void solve(Solver&& solver, const Piece& piece, Take take_hit) {
      if (!all_) {
        if (solver.solve(piece)) take_hit(solver.hit());
        return;
      }
      std::vector<PatchHit> hits;
      solver.solve(piece, hits);
      for (const PatchHit& hit : hits) take_hit(hit);
    }

    const StartPatch& start_;
    Approach& approach_;
    TreeTotals& totals_;
    std::optional<Found>* nearest_;
    std::vector<Found>* all_;
    bool is_found_ = false;
    std::optional<RayFrame> frame_;
    double error_;      ///< of coordinates in the ray's frame
    bool any_ = false;  ///< whether any hit will do
    int cells_ = 0;     ///< that solvers have looked at, where all hits are asked for
  };

  static const PolynomialPatch<S>& polynomial_of(const PatchNode<S>& patch) {
    return static_cast<const PolynomialPatch<S>&>(patch);
  }
  /// Across a side where second derivatives agree, a patch and its neighbour's polynomial differ by the third power of
  /// the distance: at this one, by less than rounding.
  static constexpr double smooth_radius = 0x1p-20;
  SHAOLIN_FLATTEN static Jet jet(const Found& found) {
    return shaolin::jet(polynomial_of(*found.patch).window(), found.at);
  }
  static double position_error(const Found& found, const Jet& jet);
  static LimitSample sample(const PatchNode<S>& patch, const Jet& jet, const SurfaceParameter& at,
                            const SchemeSurface<S>& surface);
};

/// The surface at a hit: from the polynomial where it is as good as evaluation from the control face, that is, unless
/// the piece is so small that differences of its absolute coordinates lose the normal's digits.
template <Scheme S>
LimitSample ExactFinish<S>::sample(const PatchNode<S>& patch, const Jet& jet, const SurfaceParameter& at,
                                   const SchemeSurface<S>& surface) {
  constexpr int deepest_absolute = 8;
  if (patch.place().level() > deepest_absolute || surface.control_mesh().is_collapsed(at.face)) {
    // The position stays the patch's own: near u or v = 1 parameters are too coarse to find it again.
    LimitSample sample = *surface.evaluate(at);
    sample.position = jet.position;
    return sample;
  }
  Derivatives d = jet.derivatives;
  const Vec3 normal = detail::unit_normal(d.du, d.dv);
  const Parameter inverse = patch.place().domain().scale.cwiseInverse();
  d.du *= inverse.x();
  d.dv *= inverse.y();
  d.duu *= inverse.x() * inverse.x();
  d.duv *= inverse.x() * inverse.y();
  d.dvv *= inverse.y() * inverse.y();
  return {jet.position, normal, d};
}

/// Of a certified hit: the zero is within the radius r, over which the surface moves by what its derivatives say, and
/// half of its second derivatives. Those are at most 4 n (n - 1) times the extent of the control points; below 2^-30
/// they are lost among the errors of coordinates, which both positions carry.
template <Scheme S>
double ExactFinish<S>::position_error(const Found& found, const Jet& jet) {
  const Parameter& r = found.radius;
  double error =
      jet.derivatives.du.norm() * r.x() + jet.derivatives.dv.norm() * r.y() + 2 * std::numbers::sqrt3 * found.error;
  if (const double length = r.sum(); length > 0x1p-30) {
    const Box hull = hull_of(polynomial_of(*found.patch).net());
    error += 2.1 * Polynomial::degree * (Polynomial::degree - 1) * (hull.upper - hull.lower).norm() * length * length;
  }
  return error;
}

/// The patch's shadow list: the parts that the ray's box test leaves, front to back.
template <Scheme S>
template <Query query>
void ExactFinish<S>::Search::descend(const PatchNode<S>& patch, typename Parts<S>::Slot& slot, bool is_tiny) {
  const Parts<S>* parts = slot.load(std::memory_order_acquire);
  if (!parts || is_tiny) {
    if (!may_meet(patch, is_tiny)) return;
    parts = &Parts<S>::of(patch, slot, approach_.space, totals_);
  }
  BoxOrder shadow_list(parts->first(), approach_.box_ray, approach_.box_far());
  if (parts->second()) shadow_list.add(*parts->second(), 8, approach_.box_ray, approach_.box_far());
  for (std::size_t i = 0; i < shadow_list.count() && shadow_list.distance(i) <= approach_.box_far(); ++i) {
    const typename Parts<S>::Part part = parts->part(shadow_list.box(i));
    if (part.parts)
      descend<query>(part.patch, *part.parts, part.is_tiny);
    else
      finish(part.patch, part.piece, *part.variation);
    if (query == Query::any && is_found_) return;
  }
}

/// RP and CP tests of a patch's control points. A patch whose parts are known has been through them for another ray;
/// its parts' boxes are quicker to ask. So that this changes no answer, they pass whatever a leaf's may pass: twice its
/// error. A tiny patch that is a point seen from the ray is met here.
template <Scheme S>
bool ExactFinish<S>::Search::may_meet(const PatchNode<S>& patch, bool is_tiny) {
  ++approach_.counters.hull_tests;
  if (patch.is_polynomial()) return may_meet(frame().hull(polynomial_of(patch).net()));
  const Patch<S>& irregular = static_cast<const IrregularPatch<S>&>(patch).patch();
  const Box hull = frame().hull(irregular.points).expanded(irregular.configuration->hull_expansion());
  if (!may_meet(hull)) return false;
  const Vec3 &low = hull.lower, &high = hull.upper;
  // Around an irregular corner patches shrink without end; one that lies within rounding of the ray is a point.
  if (is_tiny && std::max({high.x(), -low.x(), high.y(), -low.y()}) <= 4 * error_ &&
      high.z() - low.z() <= 64 * error_) {
    finish_as_point(patch, irregular, hull);
    return false;
  }
  // Where patches shrink by 0.93 a level or less, rounding error is reached in as many levels.
  constexpr int most_levels = 500;
  if (patch.place().level() >= most_levels)
    throw InputError("a patch does not shrink to a point in " + std::to_string(most_levels) +
                     " levels: the masks of the scheme do not converge; see 'shaolin scheme check'");
  return true;
}

template <Scheme S>
void ExactFinish<S>::Search::finish(const PatchNode<S>& patch, int number, const Variation& variation) {
  if (!patch.is_polynomial()) return finish_by_refinement(static_cast<const IrregularPatch<S>&>(patch));
  const SplineWindow<Polynomial> window = polynomial_of(patch).window();
  const SubDomain piece = Pieces<Polynomial>::domain(number);
  const auto take_hit = [&](PatchHit hit) {
    hit.at = piece(hit.at);
    hit.radius = hit.radius.cwiseProduct(piece.scale.cwiseAbs());
    take(patch, hit, number);
  };
  using Flat = FlatFinish<Polynomial>;
  PatchHit clear;
  const auto verdict =
      Flat(window, piece, variation)
          .solve(approach_.ray, approach_.far(), approach_.far_is_hit(), error_, any_, approach_.counters, clear);
  if (verdict == Flat::Verdict::found) take_hit(clear);
  if (verdict != Flat::Verdict::unknown) return;
  Net cell;
  if (!project(window, number, cell)) return;
  NewtonFinish<Polynomial> solver(error_, approach_.ray.near, approach_.far(), approach_.far_is_hit(),
                                  approach_.counters, all_ ? cells_ : 0);
  if (any_) solver.settle_for_any();
  solve(solver, cell, take_hit);
  cells_ = solver.cells();
}

/// A piece of a patch in the ray's coordinates; false if a test of the planes finds it to one side, before the others
/// are made. These are the first tests of NewtonFinish, and turn away most.
template <Scheme S>
SHAOLIN_FLATTEN bool ExactFinish<S>::Search::project(const SplineWindow<Polynomial>& patch, int number, Net& piece) {
  const auto make = [&](RayFrame::Axis axis, std::array<double, 16>& to) {
    if (number == 0) return frame().project(patch, axis, to);
    std::array<double, 16> whole;
    frame().project(patch, axis, whole);
    pieces_of<Polynomial>.restrict_to(number, whole, to);
  };
  make(RayFrame::Axis::x, piece.x);
  if (const Range x(piece.x); x.low > error_ || x.high < -error_) return false;
  make(RayFrame::Axis::y, piece.y);
  if (const Range y(piece.y); y.low > error_ || y.high < -error_) return false;
  make(RayFrame::Axis::z, piece.z);
  return true;
}

/// Masks with negative weights amplify rounding: by as much as their limit functions' absolute values sum to, a level;
/// four times the polynomials' error covers the 50 levels of a sum of 2.
template <Scheme S>
void ExactFinish<S>::Search::finish_by_refinement(const IrregularPatch<S>& patch) {
  Patch<S> projected = patch.patch();
  for (Vec3& point : projected.points) point = frame().project(point);
  RefiningFinish<S> solver(4 * error_, approach_.ray.near, approach_.far(), approach_.far_is_hit(), approach_.counters);
  solve(solver, projected, [&](const PatchHit& hit) { take(patch, hit, 0); });
}

/// The whole patch is one point to within rounding, and the irregular corner stands for it: rays aimed there are the
/// most likely to come here, and evaluation is exact there. It is the corner whose part is split as the patch itself.
template <Scheme S>
void ExactFinish<S>::Search::finish_as_point(const PatchNode<S>& patch, const Patch<S>& irregular, const Box& hull) {
  if (hull.upper.z() < approach_.ray.near - error_) return;
  Parameter at = D::centre();
  Patch<S> around = irregular;
  for (int k = 0; k < D::corner_count; ++k) {
    if (irregular.configuration->child(k).configuration != irregular.configuration) continue;
    at = Parameter(D::corners[static_cast<std::size_t>(k)][0], D::corners[static_cast<std::size_t>(k)][1]);
    // To where all of it is the corner's limit.
    constexpr int most_levels = 64;
    for (int level = 0; level < most_levels; ++level) {
      const Box left = frame().hull(around.points);
      if ((left.upper - left.lower).maxCoeff() <= 0.25 * error_) break;
      around = around.child(k);
    }
    break;
  }
  const double distance = std::max(frame().project(around.points.front()).z(), approach_.ray.near);
  if (distance > approach_.far() - (approach_.far_is_hit() ? error_ : 0)) return;
  take(patch, {at, distance, hull.upper.z() - hull.lower.z()}, 0);
}

}  // namespace shaolin
