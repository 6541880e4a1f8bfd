#pragma once
/// Around an irregular corner: how near to the characteristic net a net must be, so that the limit nowhere turns over.
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "jacobian.h"
#include "limit_rows.h"
#include "regular_layout.h"

namespace shaolin {

/// Of a split that leads to its own configuration, while the other children are regular: P -> A P, whose eigenvalues
/// are 1, then lambda_1 >= lambda_2 > 0, then smaller ones. With left and right eigenvectors w and x,
///
///     P = x_0 (w_0 P) + X M + R,    X = (x_1 x_2),    M = (w_1 P, w_2 P),
///
/// for P in the coordinates of a plane. Seen in the basis M, with its axes scaled by lambda_1^-j and lambda_2^-j, the
/// net after j splits is X + R_j, where R_j's columns are (A / lambda_1)^j and (A / lambda_2)^j times those of R M^-1.
/// On the modes that R consists of the powers of A / lambda_2 are bounded (and those of A / lambda_1 smaller). So if R
/// M^-1 is small enough, the Jacobian is positive on the rings of all levels, as that of the characteristic map (Reif
/// 1995; Peters and Reif 2008) X is, whose coefficients are checked here.
struct CornerRegularity {
  Eigen::Matrix<double, Eigen::Dynamic, 3> left;   ///< w
  Eigen::Matrix<double, Eigen::Dynamic, 3> right;  ///< x
  double tolerance;                                ///< of the rows of R M^-1

  /// True if the Jacobian of x and y is positive all around the corner, for the points' errors of up to `error`.
  bool holds_for(std::span<const Vec3> points, double error) const;
};

/// A child as the certificate needs it.
struct RingChild {
  Eigen::MatrixXd split;
  Eigen::MatrixXd bezier;  ///< Bezier points from the child's points; empty if it is the corner's own
};

/// Bounds how far R M^-1 may grow, with what is left of the least Jacobian of the characteristic map's ring. Found by
/// eigenvectors in double, checked to 1e-9. Empty if there is no such net, or its own Jacobian is not positive.
/// O(points^3).
template <class Regular>
std::optional<CornerRegularity> corner_regularity(const std::vector<RingChild>& children, int corner,
                                                  const LimitRows& rows);

extern template std::optional<CornerRegularity> corner_regularity<BezierQuad>(const std::vector<RingChild>&, int,
                                                                              const LimitRows&);
extern template std::optional<CornerRegularity> corner_regularity<BezierTriangle>(const std::vector<RingChild>&, int,
                                                                                  const LimitRows&);

}  // namespace shaolin
