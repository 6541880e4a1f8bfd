#pragma once
/// Proof that a ray crosses the surface once where patches meet: at edges, creases and vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "../schemes/scheme_surface.h"
#include "overlap.h"
#include "ray_frame.h"

namespace shaolin {

/// A disk of the surface around one of its points, seen along a ray.
///
/// Its image in the plane across the ray winds around the ray's point as often as its rim does. If that is once, and
/// the Jacobian of the map to that plane is positive in all of the disk's faces (negative where the rim winds the other
/// way), the ray has one point in the disk: each counts 1 or more, on seams and at the vertex, too, where only the
/// derivatives' sizes jump or vanish (Reif 1995). Of a smaller disk the winding alone says that the point is in it: its
/// hull bounds how far away. All of this holds for the control points to within rounding, hence for the exact surface.
///
/// A disk of radius r = 2^-l, in parameters of a face, is made of sectors: of each face that has the point, for each
/// way to go from there, a corner of that size. It is part of one polynomial or, at an irregular corner, the patch of
/// level l, whose ring of polynomials has the rim. Where a sector is neither there is no disk of this level.
template <Scheme S>
class DiskProof {
 public:
  /// Both must outlive this. The ray is finite.
  DiskProof(const SchemeSurface<S>& surface, const TraversalRay& ray) : surface_(surface), ray_(ray) {}

  /// How far at most the one crossing near a place of the surface is from `position`, which is about there; empty if
  /// none is proven: along tangents, at outlines and boundaries, and where the surface has no polynomials. O(valence)
  /// for each of some 50 levels. Throws InputError if the surface has no such place.
  std::optional<double> error_at(const SurfaceParameter& at, const Vec3& position) const;

 private:
  using D = Domain<S::face_kind>;
  using Regular = RegularPatch<S::face_kind>;
  static constexpr bool quads = S::face_kind == FaceKind::quad;
  static constexpr int sectors_around = quads ? 4 : 6;
  /// Centres are multiples of 2^-50: so are 1 - u and the like across sides, and splits down to level 50 round nothing.
  static constexpr int deepest = 48;
  static constexpr double grid = 0x1p-50;

  /// The plane across the ray, and the distance along it; mirrored if the ray meets the surface from below.
  struct Plane {
    const RayFrame& frame;
    bool is_mirrored;
    Vec3 operator()(const Vec3& point) const {
      const Vec3 seen = frame.project(point);
      return is_mirrored ? Vec3(seen.y(), seen.x(), seen.z()) : seen;
    }
  };
  /// What is seen of a sector: a box that holds it, and the control points of its part of the rim, counter-clockwise.
  struct Outline {
    Box hull;
    std::vector<std::vector<Vec3>> rim;
  };

  /// From a place in a patch into one of the sectors around it, between way(number) and the next.
  class Sector {
   public:
    /// `level`: of the patch, its side is 2^-level of its face's.
    Sector(Patch<S> patch, const Parameter& at, int number, int level)
        : patch_(std::move(patch)), at_(at), number_(number), level_(level) {}

    /// Makes the sector one of this level, not above the last. False if it is not part of one polynomial, nor the
    /// corner of an irregular patch.
    bool descend_to(int level);
    /// Empty if children of an irregular patch that have its rim are not polynomials.
    std::optional<Outline> outline(const Plane& plane) const;
    bool has_positive_jacobian(const Plane& plane, double error) const;
    const std::vector<Vec3>& points() const { return patch_.points; }

   private:
    Regular piece(const Plane& plane) const;
    std::optional<int> corner() const;

    Patch<S> patch_;
    Parameter at_;
    int number_, level_;
    double size_ = 1;  ///< in the patch's parameters
  };

  /// By the sides of a patch, counter-clockwise from its first corner.
  static constexpr auto side_places() {
    if constexpr (quads)
      return std::array<std::array<std::size_t, 4>, 4>{{{0, 1, 2, 3}, {3, 7, 11, 15}, {15, 14, 13, 12}, {12, 8, 4, 0}}};
    else
      return std::array<std::array<std::size_t, 5>, 3>{{{0, 1, 2, 3, 4}, {4, 8, 11, 13, 14}, {14, 12, 9, 5, 0}}};
  }
  static std::vector<Vec3> side(const Regular& piece, int k) {
    static constexpr auto places = side_places();
    std::vector<Vec3> curve;
    for (const std::size_t place : places[static_cast<std::size_t>(k % D::corner_count)])
      curve.push_back(piece.b[place]);
    return curve;
  }
  /// The ways that bound sector k, counter-clockwise: along u, along v and back; on triangles six.
  static Parameter way(int k) {
    static constexpr double of_quad[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    static constexpr double of_triangle[6][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
    const double* way = quads ? of_quad[k % 4] : of_triangle[k % 6];
    return {way[0], way[1]};
  }

  std::optional<double> error_around(const SurfaceParameter& centre, double distance, const Vec3& position) const;
  std::vector<Sector> sectors_at(const SurfaceParameter& centre) const;
  static std::optional<std::vector<Outline>> outlines_at(std::vector<Sector>& sectors, int level,
                                                         const RayFrame& frame);
  static std::optional<int> turns(std::span<const Outline> outlines, double error);
  static std::optional<double> angle(std::vector<Vec3> curve, double clearance, int halvings);

  const SchemeSurface<S>& surface_;
  const TraversalRay& ray_;
};

template <Scheme S>
bool DiskProof<S>::Sector::descend_to(int level) {
  while (!patch_.is_regular() && level_ < level) {
    // Between children, the one that the sector lies in.
    const Parameter middle = way(number_) + way(number_ + 1);
    const auto is_beyond = [](double x, double towards) { return x > 0.5 || (x == 0.5 && towards > 0); };
    const bool right = is_beyond(at_.x(), middle.x()), upper = is_beyond(at_.y(), middle.y());
    int child = 0;
    if constexpr (quads)
      child = upper ? (right ? 2 : 3) : right;
    else
      child = right ? 1 : upper ? 2 : is_beyond(at_.sum(), middle.sum()) ? 3 : 0;
    at_ = (at_ - D::to_parent(child, Parameter::Zero())) / D::scale(child);
    if (D::scale(child) < 0) number_ = (number_ + sectors_around / 2) % sectors_around;
    patch_ = patch_.child(child);
    ++level_;
  }
  if (level_ > level) return false;
  size_ = std::ldexp(1.0, level_ - level);
  if (!patch_.is_regular()) return corner().has_value();
  const Parameter first = at_ + size_ * way(number_), second = at_ + size_ * way(number_ + 1);
  return D::contains(first) && D::contains(second);
}

/// Of an irregular patch, the corner that the sector is at.
template <Scheme S>
std::optional<int> DiskProof<S>::Sector::corner() const {
  for (int k = 0; k < D::corner_count; ++k)
    if (at_ == Parameter(D::corners[static_cast<std::size_t>(k)][0], D::corners[static_cast<std::size_t>(k)][1]))
      return k;
  return {};
}

/// The part of the polynomial that is the sector, with its own corner first on triangles, the lower left one on quads.
template <Scheme S>
auto DiskProof<S>::Sector::piece(const Plane& plane) const -> Regular {
  Regular whole = patch_.regular();
  for (Vec3& point : whole.b) point = plane(point);
  const Parameter first = at_ + size_ * way(number_), second = at_ + size_ * way(number_ + 1);
  if constexpr (quads) {
    const Parameter opposite = first + second - at_;
    return whole.restricted(at_.cwiseMin(opposite), at_.cwiseMax(opposite));
  } else {
    return whole.restricted({at_, first, second});
  }
}

template <Scheme S>
auto DiskProof<S>::Sector::outline(const Plane& plane) const -> std::optional<Outline> {
  Outline outline;
  if (patch_.is_regular()) {
    const Regular piece = this->piece(plane);
    outline.hull = hull_of(piece.b);
    if constexpr (quads)
      outline.rim = {side(piece, number_ + 1), side(piece, number_ + 2)};
    else
      outline.rim = {side(piece, 1)};
    return outline;
  }
  const int k = *corner();
  for (const Vec3& point : patch_.points) outline.hull.add(plane(point));
  outline.hull = outline.hull.expanded(patch_.configuration->hull_expansion());
  // A side of the patch is that of two children.
  for (int s = k + 1; s < k + D::corner_count - 1; ++s)
    for (const int child : {s % D::corner_count, (s + 1) % D::corner_count}) {
      const Patch<S> beyond = patch_.child(child);
      if (!beyond.is_regular()) return {};
      Regular piece = beyond.regular();
      for (Vec3& point : piece.b) point = plane(point);
      outline.rim.push_back(side(piece, s));
    }
  return outline;
}

template <Scheme S>
bool DiskProof<S>::Sector::has_positive_jacobian(const Plane& plane, double error) const {
  constexpr int cuts = 2, splits = 2;
  if (patch_.is_regular()) return detail::has_positive_jacobian(piece(plane), error, cuts);
  Patch<S> seen = patch_;
  for (Vec3& point : seen.points) point = plane(point);
  int budget = 64;
  return detail::has_positive_jacobian(seen, error, splits, budget);
}

/// The angle by which a curve turns around the origin of the plane, if its control points are on one side, farther than
/// the clearance: then so is the curve. Otherwise that of its halves.
template <Scheme S>
std::optional<double> DiskProof<S>::angle(std::vector<Vec3> curve, double clearance, int halvings) {
  const Eigen::Vector2d first = curve.front().template head<2>(), last = curve.back().template head<2>();
  const Eigen::Vector2d middle = (first.stableNormalized() + last.stableNormalized()).stableNormalized();
  const auto is_beyond = [&](const Vec3& point) { return point.template head<2>().dot(middle) > clearance; };
  if (std::all_of(curve.begin(), curve.end(), is_beyond))
    return std::atan2(first.x() * last.y() - first.y() * last.x(), first.dot(last));
  if (halvings == 0 || !(first.norm() > clearance && last.norm() > clearance)) return {};
  std::vector<Vec3> second(curve.size());
  const std::size_t end = curve.size() - 1;
  for (std::size_t pass = 0; pass <= end; ++pass) {
    second[end - pass] = curve[end];
    for (std::size_t i = end; i > pass; --i) curve[i] = 0.5 * (curve[i - 1] + curve[i]);
  }
  const auto of_first = angle(std::move(curve), clearance, halvings - 1);
  const auto of_second = angle(std::move(second), clearance, halvings - 1);
  if (!of_first || !of_second) return {};
  return *of_first + *of_second;
}

/// The rim's curves are the exact ones to within the error, at their ends, too; so where all of them are farther than
/// 16 errors from the ray, and farther than as many as there are curves, their angles together are off by less than 2.
template <Scheme S>
std::optional<int> DiskProof<S>::turns(std::span<const Outline> outlines, double error) {
  constexpr int most_halvings = 3;
  std::size_t curves = 0;
  for (const Outline& outline : outlines) curves += outline.rim.size();
  const double clearance = error * std::max(16.0, static_cast<double>(curves));
  double sum = 0;
  for (const Outline& outline : outlines)
    for (const std::vector<Vec3>& curve : outline.rim) {
      const std::optional<double> turned = DiskProof::angle(curve, clearance, most_halvings);
      if (!turned) return {};
      sum += *turned;
    }
  return static_cast<int>(std::round(sum / (2 * std::numbers::pi)));
}

template <Scheme S>
auto DiskProof<S>::sectors_at(const SurfaceParameter& centre) const -> std::vector<Sector> {
  const PointPlaces places = surface_.places_of(centre);
  std::vector<Sector> sectors;
  if (!places.is_closed) return sectors;
  for (const SurfaceParameter& place : places.all) {
    const Parameter at(place.u, place.v);
    const int level = surface_.splits_by_corner(place.face) ? 1 : 0;
    const Patch<S> patch = surface_.patch(place.face, place.sub);
    for (int k = 0; k < sectors_around; ++k)
      if (D::contains(at + grid * way(k)) && D::contains(at + grid * way(k + 1)))
        sectors.emplace_back(patch, at, k, level);
  }
  return sectors;
}

template <Scheme S>
std::optional<double> DiskProof<S>::error_around(const SurfaceParameter& centre, double distance,
                                                 const Vec3& position) const {
  std::vector<Sector> sectors = sectors_at(centre);
  if (sectors.empty()) return {};
  Box box;
  for (const Sector& sector : sectors)
    for (const Vec3& point : sector.points()) box.add(point);
  box.add(position);
  const RayFrame frame(ray_, surface_.evaluate(centre)->normal);
  // Restricting a polynomial is a few convex combinations more than RayFrame::error() allows for.
  const double error = 2 * RayFrame::error(ray_.origin, box);

  const auto is_proven = [&](int level) {
    const auto outlines = outlines_at(sectors, level, frame);
    const int turned = outlines ? turns(*outlines, error).value_or(0) : 0;
    const Plane plane{frame, turned < 0};
    return std::abs(turned) == 1 && std::all_of(sectors.begin(), sectors.end(), [&](const Sector& sector) {
             return sector.has_positive_jacobian(plane, error);
           });
  };
  const int last = distance > 0 ? std::min(deepest, -std::ilogb(2 * distance) - 1) : deepest;
  int level = 1;
  while (level <= last && !is_proven(level)) ++level;
  if (level > last) return {};

  // How small the disk may be. Around a vertex its turns stay the same down to where the rim is too near.
  for (const int step : {16, 8, 4, 2, 1}) {
    std::vector<Sector> smaller = sectors;
    while (level + step <= deepest) {
      const auto outlines = outlines_at(smaller, level + step, frame);
      if (!outlines || std::abs(turns(*outlines, error).value_or(0)) != 1) break;
      level += step;
      sectors = smaller;
    }
  }
  Box hull;
  const auto smallest = outlines_at(sectors, level, frame);
  for (const Outline& outline : *smallest) {
    hull.add(outline.hull.lower);
    hull.add(outline.hull.upper);
  }
  const Vec3 from = frame.project(position);
  return (hull.upper - from).cwiseMax(from - hull.lower).norm() + 2 * std::numbers::sqrt3 * error;
}

/// Empty if one of them is no sector of this level.
template <Scheme S>
auto DiskProof<S>::outlines_at(std::vector<Sector>& sectors, int level, const RayFrame& frame)
    -> std::optional<std::vector<Outline>> {
  std::vector<Outline> outlines;
  for (Sector& sector : sectors) {
    if (!sector.descend_to(level)) return {};
    std::optional<Outline> outline = sector.outline({frame, false});
    if (!outline) return {};
    outlines.push_back(std::move(*outline));
  }
  return outlines;
}

template <Scheme S>
std::optional<double> DiskProof<S>::error_at(const SurfaceParameter& at, const Vec3& position) const {
  // The nearest place of each side and the corners, on the grid; on the sides of large cells where rounding may have
  // led away from them, for a disk beside one would have to be as small.
  const auto on_grid = [](double x) {
    constexpr double cell = 0x1p-16, rounding = 0x1p-42;
    const double side = cell * std::round(x / cell);
    return std::abs(x - side) < rounding ? side : grid * std::round(x / grid);
  };
  const Parameter here(at.u, at.v);
  std::vector<Parameter> centres;
  if constexpr (quads) {
    for (const double end : {0.0, 1.0}) {
      centres.emplace_back(on_grid(at.u), end);
      centres.emplace_back(end, on_grid(at.v));
    }
  } else {
    centres.emplace_back(on_grid(at.u), 0);
    centres.emplace_back(0, on_grid(at.v));
    const double along = on_grid(std::clamp(0.5 * (1 + at.u - at.v), 0.0, 1.0));
    centres.emplace_back(along, 1 - along);
  }
  for (const auto& corner : D::corners) centres.emplace_back(corner[0], corner[1]);
  centres.push_back(D::nearest({on_grid(at.u), on_grid(at.v)}));

  // Nearest first: a disk must hold the hit, and the smaller it can be the less is its hull.
  constexpr double farthest = 0x1p-10;
  const auto distance = [&](const Parameter& centre) { return (centre - here).template lpNorm<Eigen::Infinity>(); };
  std::stable_sort(centres.begin(), centres.end(),
                   [&](const Parameter& a, const Parameter& b) { return distance(a) < distance(b); });
  centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
  for (const Parameter& centre : centres) {
    if (distance(centre) > farthest) break;
    if (const auto error = error_around({at.face, at.sub, centre.x(), centre.y()}, distance(centre), position))
      return error;
  }
  return {};
}

}  // namespace shaolin
