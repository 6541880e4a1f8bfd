#pragma once
/// Limit masks that nobody wrote down: from the eigenvectors of the subdivision matrix around a point.
#include <Eigen/Core>
#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "ring.h"
#include "split_program.h"
#include "vec3.h"

namespace shaolin {

/// The matrix of a split: child points = matrix * parent points. Columns are found by refining unit vectors, so they
/// are what refinement does, whatever the masks say. O(point_count^2).
Eigen::MatrixXd matrix_of(const SplitProgram& program, int parent_points);

/// Its eigenvalues, the largest modulus first.
std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix);

/// An orthonormal basis of the `count` directions that a square matrix shrinks most: its null space, for a matrix of
/// that nullity. By a pivoted QR decomposition of the transpose, whose last columns are orthogonal to all rows. O(n^3).
Eigen::MatrixXd null_space(const Eigen::MatrixXd& matrix, int count);

/// Position and, where the surface has one, the unit normal at a corner.
struct LimitAtCorner {
  Vec3 position;
  std::optional<Vec3> normal;
};

/// Masks over the points that the matrix stands for: the limit position, and two tangents if the surface has a tangent
/// plane there. Their cross product is the outward normal times a positive factor.
struct LimitRows {
  Eigen::VectorXd position;
  std::optional<Eigen::Matrix<double, Eigen::Dynamic, 2>> tangents;

  /// The masks' sums over these points, as many as there are rows.
  LimitAtCorner at(std::span<const Vec3> points) const;
};

/// The left eigenvector of eigenvalue 1, and those of the next two eigenvalues if these are real, positive and larger
/// than all others (Doo and Sabin 1978; Reif 1995). `ring` is the ring of the point that the matrix shrinks to: laid
/// out flat, counter-clockwise, it gives the tangents their orientation. Empty if 1 is not the single largest
/// eigenvalue: then refinement does not converge to a point. O(points^3).
std::optional<LimitRows> limit_rows(const Eigen::MatrixXd& matrix, const Ring& ring);

}  // namespace shaolin
