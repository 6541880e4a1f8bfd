#pragma once
/// Whether a patch, projected to its plane TP, may overlap itself: equation 6 of the paper (section 8.1).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "../schemes/jacobian.h"
#include "../schemes/patch.h"

namespace shaolin {

/// True if the edges (pairs of places among the points), projected along `normal`, are a planar straight-line graph: no
/// edge shrinks to a point, and two of them meet at most in an end that both name. Decided exactly on the doubles as
/// they are stored, by CGAL's predicates on points that are projected without rounding; most signs are certain before
/// that, in double with an error bound. False if points or normal are not finite, or the normal is zero. O(edges^2).
bool is_planar_straight_line_graph(std::span<const Vec3> points, std::span<const std::array<int, 2>> edges,
                                   const Vec3& normal);

/// True if the patch is valid for sure, for the plane of that normal:
///
/// - its control net (all faces that touch its own, less what lies beyond infinitely sharp edges and has no influence),
///   at level 0, 1, 2 or 3 of its refinement, projects to a planar straight-line graph: the paper's criterion, decided
///   exactly;
/// - the Jacobian of the projected limit, normal . (du x dv), is positive over the whole patch but for irregular
///   corners, by bounds that include rounding.
///
/// The first does not prove equation 6 (a planar net may have a limit that folds), the second does: where the Jacobian
/// has one sign, the number of the patch's points over a point p of TP is the number of times that the patch's border
/// runs around p. Each border curve can be drawn tight to its chord within its hull; so around a p outside all hulls
/// the border runs as the chord triangle's does, and p lies in it.
///
/// False means "not certain". The normal need not be of unit length; zero or not finite gives false. A regular patch
/// that is bent a little takes a microsecond (its edges are compared with their mean, which proves both); others
/// O(edges^2) for the graphs and a bounded number of splits for the Jacobian. Without polynomials nothing proves the
/// Jacobian's sign yet: false.
template <Scheme S>
bool projects_without_overlap(const Patch<S>& patch, const Vec3& normal);

namespace detail {

/// Right-handed axes whose third is the normal's direction.
struct PlaneAxes {
  Vec3 u, v, n;

  explicit PlaneAxes(const Vec3& normal) : n(normal.stableNormalized()) {
    u = n.unitOrthogonal();
    v = n.cross(u);
  }
  Vec3 operator()(const Vec3& p) const { return {u.dot(p), v.dot(p), n.dot(p)}; }
};

/// A patch in the axes of its plane, about its first point.
template <Scheme S>
struct ProjectedPatch {
  Patch<S> patch;
  /// Bounds the error of differences of points, of phantoms, of Bezier points and of children a few levels down, for
  /// extent D = the largest distance from the first point and u = 2^-53: a point's own is 12 u D (a subtraction, a dot
  /// product, the axes), phantoms weigh up to 9 of them together (see SplinePoint), a split adds 10 u D. So a point's
  /// stays below 256 u D.
  double error;

  ProjectedPatch(const Patch<S>& original, const Vec3& normal) : patch(original) {
    const PlaneAxes axes(normal);
    const Vec3 origin = original.points.front();
    double extent = 0;
    for (Vec3& p : patch.points) {
      p = axes(p - origin);
      extent = std::max(extent, p.allFinite() ? p.norm() : std::numeric_limits<double>::infinity());
    }
    error = 512 * 0x1p-53 * extent;
  }
};

/// Edges of the spline's control points that run along u and along v, as pairs of places in the order of
/// from_spline(). The hulls of their differences hold the derivatives: those of a B-spline are splines over them.
template <class Regular>
struct LatticeEdges;

template <>
struct LatticeEdges<BezierQuad> {
  static constexpr const auto& along_u = BezierQuad::u_pairs;
  static constexpr const auto& along_v = BezierQuad::v_pairs;
};

/// Corners at (0, 0), (1, 0), (0, 1); across their sides (1, -1), (1, 1), (-1, 1); beside corner 0 (-1, 0), (0, -1),
/// corner 1 (2, -1), (2, 0), corner 2 (0, 2), (-1, 2).
template <>
struct LatticeEdges<BezierTriangle> {
  using Pair = BezierTriangle::Pair;
  static constexpr std::array<Pair, 8> along_u{{{7, 3}, {3, 8}, {6, 0}, {0, 1}, {1, 9}, {5, 2}, {2, 4}, {11, 10}}};
  static constexpr std::array<Pair, 8> along_v{{{6, 5}, {5, 11}, {7, 0}, {0, 2}, {2, 10}, {3, 1}, {1, 4}, {8, 9}}};
};

/// True if a regular patch is bent so little that its net and its limit are one to one for sure. In the basis of the
/// mean edges along u and v let all edges along u lie within r_u of (1, 0), and those along v within r_v of (0, 1). A
/// map of a convex domain whose derivative is I + E with |E| < 1 is one to one (x . (x + E x) > 0) and its Jacobian is
/// positive; |E|^2 <= r_u^2 + r_v^2. That holds for the limit, whose derivatives lie in the edges' hulls, and for the
/// net as the image of the lattice (affine on triangles, bilinear on quads; the lattice of the twelve points of a
/// triangle is convex, too), so its edges cross nowhere. Where there are phantoms beyond a crease, the net is a part of
/// the lattice.
template <class Regular>
bool is_nearly_affine(const std::array<Vec3, Regular::spline_size>& p, double error) {
  using Edges = LatticeEdges<Regular>;
  const auto difference = [&](const auto& pair) -> Eigen::Vector2d {
    return (p[pair[1]] - p[pair[0]]).template head<2>();
  };
  const auto mean = [&](const auto& pairs) -> Eigen::Vector2d {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const auto& pair : pairs) sum += difference(pair);
    return sum / static_cast<double>(pairs.size());
  };
  Eigen::Matrix2d basis, inverse;
  basis << mean(Edges::along_u), mean(Edges::along_v);
  const double determinant = basis.determinant();
  if (!(determinant > 0)) return false;
  inverse << basis(1, 1), -basis(0, 1), -basis(1, 0), basis(0, 0);
  inverse /= determinant;
  const auto farthest = [&](const auto& pairs, const Eigen::Vector2d& from) {
    double largest = 0;
    for (const auto& pair : pairs) largest = std::max(largest, (inverse * difference(pair) - from).squaredNorm());
    return largest;
  };
  const double bending =
      farthest(Edges::along_u, Eigen::Vector2d::UnitX()) + farthest(Edges::along_v, Eigen::Vector2d::UnitY());
  // (sqrt(0.9) + 2 sqrt(2) 1e-3)^2 < 1; the inverse's own rounding is far below.
  return bending <= 0.9 && 2 * error * inverse.norm() <= 1e-3;
}

/// True if the coefficients of the Jacobian are positive for sure, of the piece or of its quarters after `cuts` splits.
/// The piece's points are in the plane's axes. A corner's coefficient is the Jacobian there, and negative ones end the
/// search.
template <class Regular>
bool has_positive_jacobian(const Regular& piece, double error, int cuts) {
  const auto bound = JacobianBound<Regular>::of(piece);
  const double slack = error * (bound.largest_du + bound.largest_dv + error);
  if (bound.least > slack) return true;
  if (cuts == 0 || !(bound.least_at_corner > slack)) return false;
  const auto quarters = piece.split();
  return std::all_of(quarters.begin(), quarters.end(),
                     [&](const Regular& quarter) { return has_positive_jacobian(quarter, error, cuts - 1); });
}

/// The same of a patch in its plane's axes. An irregular one is split until its pieces are regular, or its net is so
/// near to the characteristic one of a corner that the pieces of all further levels are known to be as good (see
/// corner_regularity.h). `budget` bounds the patches that are looked at.
template <Scheme S>
bool has_positive_jacobian(const Patch<S>& patch, double error, int splits, int& budget) {
  constexpr int polynomial_cuts = 2;
  if (--budget < 0) return false;
  if (patch.is_regular()) return has_positive_jacobian(patch.regular(), error, polynomial_cuts);
  if (patch.configuration->corner_count() != Domain<S::face_kind>::corner_count) return false;
  for (int k = 0; k < patch.configuration->corner_count(); ++k)
    if (const auto& regularity = patch.configuration->corner_regularity(k))
      if (regularity->holds_for(patch.points, error)) return true;
  if (splits == 0) return false;
  const std::vector<Patch<S>> children = patch.children();
  return std::all_of(children.begin(), children.end(),
                     [&](const Patch<S>& child) { return has_positive_jacobian(child, error, splits - 1, budget); });
}

/// The control net of some patches of one level that lie side by side. Points are told apart by their coordinates: a
/// vertex has the same ones in all patches that it belongs to, to the last bit.
class JoinedNet {
 public:
  template <Scheme S>
  explicit JoinedNet(const std::vector<Patch<S>>& patches) {
    for (const Patch<S>& patch : patches) {
      std::vector<int> number;
      for (const Vec3& p : patch.points) number.push_back(number_of(p));
      for (const auto& [a, b] : patch.configuration->net_edges()) {
        const int from = number[static_cast<std::size_t>(a)], to = number[static_cast<std::size_t>(b)];
        edges_.push_back({std::min(from, to), std::max(from, to)});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }

  bool is_planar(const Vec3& normal) const { return is_planar_straight_line_graph(points_, edges_, normal); }

 private:
  struct Hash {
    std::size_t operator()(const std::array<double, 3>& p) const {
      std::size_t hash = 14695981039346656037u;
      for (const double x : p) hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211u, hash ^= hash >> 32;
      return hash;
    }
  };
  int number_of(const Vec3& p) {
    const std::array<double, 3> key{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};  // -0 is 0
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<int>(points_.size()));
    if (is_new) points_.push_back(p);
    return at->second;
  }

  std::unordered_map<std::array<double, 3>, int, Hash> numbers_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 2>> edges_;
};

template <Scheme S>
bool has_planar_net(const Patch<S>& patch, const Vec3& normal) {
  constexpr int finest_level = 3;
  if (is_planar_straight_line_graph(patch.points, patch.configuration->net_edges(), normal)) return true;
  std::vector<Patch<S>> level{patch};
  for (int l = 1; l <= finest_level; ++l) {
    std::vector<Patch<S>> finer;
    for (const Patch<S>& coarse : level)
      for (Patch<S>& child : coarse.children()) finer.push_back(std::move(child));
    level = std::move(finer);
    if (JoinedNet(level).is_planar(normal)) return true;
  }
  return false;
}

}  // namespace detail

template <Scheme S>
bool projects_without_overlap(const Patch<S>& patch, const Vec3& normal) {
  using Regular = RegularPatch<S::face_kind>;
  constexpr int most_splits = 12, most_patches = 256;
  if (basis_of(patch.configuration->scheme()) == Basis::none) return false;
  if (!normal.allFinite() || normal.isZero(0)) return false;
  const detail::ProjectedPatch<S> projected(patch, normal);
  if (!std::isfinite(projected.error)) return false;
  if (const auto& layout = patch.configuration->layout(); layout && layout->points.size() == Regular::spline_size) {
    std::array<Vec3, Regular::spline_size> spline;
    for (std::size_t i = 0; i < spline.size(); ++i) spline[i] = layout->points[i].of(projected.patch.points.data());
    if (detail::is_nearly_affine<Regular>(spline, projected.error)) return true;
  }
  int budget = most_patches;
  return detail::has_positive_jacobian(projected.patch, projected.error, most_splits, budget) &&
         detail::has_planar_net(patch, normal);
}

}  // namespace shaolin
