#pragma once
/// A plane between two convex sets that are known by their supporting points.
#include <array>
#include <limits>

#include "../schemes/vec3.h"

namespace shaolin {

namespace detail {

/// The vertices of a simplex's face that holds its point nearest to the origin, and that point.
class NearestSimplex {
 public:
  int size() const { return size_; }
  const Vec3& nearest() const { return nearest_; }

  /// Adds a vertex, and leaves out those that the nearest point has no need of. The simplex has three at most.
  void add(const Vec3& vertex) {
    const NearestSimplex before = *this;
    const int all = before.size_ + 1;
    double least = std::numeric_limits<double>::infinity();
    // The face sought has the new vertex: without it the nearest point were known.
    for (int chosen = 0; chosen < 1 << before.size_; ++chosen) {
      NearestSimplex face;
      face.vertices_[0] = vertex;
      face.size_ = 1;
      for (int i = 0; i < all - 1; ++i)
        if ((chosen >> i & 1) != 0)
          face.vertices_[static_cast<std::size_t>(face.size_++)] = before.vertices_[static_cast<std::size_t>(i)];
      if (!face.find_nearest() || !(face.nearest_.squaredNorm() < least)) continue;
      least = face.nearest_.squaredNorm();
      *this = face;
    }
  }

 private:
  /// Of the space that the vertices span; false if that point lies outside of their hull, or cannot be told.
  bool find_nearest() {
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> sides(3, size_ - 1);
    for (int i = 1; i < size_; ++i) sides.col(i - 1) = vertices_[static_cast<std::size_t>(i)] - vertices_[0];
    nearest_ = vertices_[0];
    if (size_ == 1) return true;
    const auto inverse = sides.colPivHouseholderQr();
    const Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1> weights = inverse.solve(-nearest_);
    // A way along a smaller face is known less well, so one that is as near but for rounding is taken for this one's.
    constexpr double rounding = 0x1p-40;
    if (inverse.rank() < size_ - 1 || !(weights.minCoeff() > -rounding) || !(weights.sum() < 1 + rounding))
      return false;
    nearest_ += sides * weights;
    // A short way has lost digits to the sum. Once more, and it is square to the sides to the last of those that it
    // has.
    nearest_ += sides * inverse.solve(-nearest_);
    return true;
  }

  std::array<Vec3, 4> vertices_;
  int size_ = 0;
  Vec3 nearest_ = Vec3::Zero();
};

}  // namespace detail

/// True if a plane separates two convex sets by more than a margin. `lowest(n)` is a point of their difference, the
/// points of the one less those of the other, that is least along n. The search walks towards the difference's point
/// nearest to the origin, by simplexes of such points (Gilbert, Johnson and Keerthi 1988, "A fast procedure for
/// computing the distance between complex objects in three-dimensional space"), from a first guess at the way there. It
/// finds a plane within some steps if there is one, but for rounding; where it finds none, there may still be one.
template <class Lowest>
bool are_separable(const Lowest& lowest, const Vec3& guess, double margin) {
  constexpr int most_steps = 12;
  detail::NearestSimplex simplex;
  Vec3 way = guess;
  for (int i = 0; i < most_steps; ++i) {
    const double length = way.norm();
    if (!(length > 0)) return false;
    const Vec3 n = way / length;
    const Vec3 point = lowest(n);
    if (n.dot(point) > margin) return true;
    // A point that is no nearer along the way than what is known ends the walk, as does one with the origin inside.
    if (simplex.size() > 0 && !(n.dot(point) < length)) return false;
    simplex.add(point);
    if (simplex.size() == 4) return false;
    way = simplex.nearest();
  }
  return false;
}

}  // namespace shaolin
