#include "corner_regularity.h"

#include <Eigen/LU>
#include <cmath>

namespace shaolin {

namespace {

constexpr double same = 1e-9;  // what eigenvalues and eigenvectors are good to, see limit_rows.cpp

/// Right eigenvectors of 1, lambda_1 and lambda_2, dual to the left ones. Empty if they are not what they should be.
std::optional<Eigen::Matrix<double, Eigen::Dynamic, 3>> dual_modes(const Eigen::MatrixXd& split,
                                                                   const Eigen::Matrix<double, Eigen::Dynamic, 3>& left,
                                                                   const Eigen::Vector3d& values) {
  const Eigen::Index n = split.rows();
  const auto space = [&](double value, int count) {
    return null_space(split - value * Eigen::MatrixXd::Identity(n, n), count);
  };
  Eigen::Matrix<double, Eigen::Dynamic, 3> right(n, 3);
  right.col(0).setOnes();
  if (values[1] - values[2] <= same) {
    right.rightCols<2>() = space(0.5 * (values[1] + values[2]), 2);
  } else {
    right.col(1) = space(values[1], 1);
    right.col(2) = space(values[2], 1);
  }
  const Eigen::Matrix3d pairing = left.transpose() * right;
  if (!(std::abs(pairing.determinant()) > same)) return {};
  right = (right * pairing.inverse()).eval();
  const double residual = (split * right - right * values.asDiagonal()).cwiseAbs().maxCoeff();
  if (!(residual <= same * right.cwiseAbs().maxCoeff())) return {};
  return right;
}

double row_norm(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().rowwise().sum().maxCoeff(); }

/// The largest norm of all powers of a matrix, the zeroth included: once one is at most 1, later ones are products of
/// known ones.
std::optional<double> largest_power(const Eigen::MatrixXd& matrix) {
  constexpr int most_powers = 200;
  double largest = 1;
  Eigen::MatrixXd power = matrix;
  for (int j = 0; j < most_powers; ++j) {
    const double norm = row_norm(power);
    if (!(norm < 1e6)) return {};
    if (norm <= 1) return largest;
    largest = std::max(largest, norm);
    power = (power * matrix).eval();
  }
  return {};
}

/// The least Jacobian of a piece, from its cuts: in the piece's own units, where cutting halves derivatives.
template <class Regular>
double least_jacobian(const Regular& piece, int cuts) {
  if (cuts == 0) return JacobianBound<Regular>::of(piece).least;
  double least = std::numeric_limits<double>::infinity();
  for (const Regular& quarter : piece.split()) least = std::min(least, 4 * least_jacobian(quarter, cuts - 1));
  return least;
}

/// The norm of the map from points to the differences that stand for derivatives.
template <class Regular>
double derivative_norm(const Eigen::MatrixXd& bezier) {
  double largest = 0;
  for (const auto& pairs : {std::vector(Regular::u_pairs.begin(), Regular::u_pairs.end()),
                            std::vector(Regular::v_pairs.begin(), Regular::v_pairs.end())})
    for (const auto& pair : pairs)
      largest = std::max(largest, (bezier.row(pair[1]) - bezier.row(pair[0])).cwiseAbs().sum());
  return largest;
}

}  // namespace

bool CornerRegularity::holds_for(std::span<const Vec3> points, double error) const {
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> all(
      points.front().data(), static_cast<Eigen::Index>(points.size()), 3);
  const auto net = all.leftCols<2>();
  const Eigen::Matrix<double, 3, 2> modes = left.transpose() * net;
  const Eigen::Matrix2d basis = modes.bottomRows<2>();
  const double determinant = basis.determinant();
  if (!(determinant > 0)) return false;
  const Eigen::Matrix2d inverse = basis.inverse();
  const double noise = error * (1 + left.cwiseAbs().colwise().sum().maxCoeff() * right.cwiseAbs().maxCoeff() * 3);
  if (!(noise * inverse.norm() <= 1e-3 * tolerance)) return false;
  const double farthest = ((net - right * modes) * inverse).rowwise().norm().maxCoeff();
  return farthest <= 0.99 * tolerance;
}

template <class Regular>
std::optional<CornerRegularity> corner_regularity(const std::vector<RingChild>& children, int corner,
                                                  const LimitRows& rows) {
  if (!rows.tangents) return {};
  const Eigen::MatrixXd& own = children[static_cast<std::size_t>(corner)].split;
  const Eigen::Index n = own.rows();
  CornerRegularity result;
  result.left.resize(n, 3);
  result.left << rows.position, *rows.tangents;
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd w = result.left.col(i);
    values[i] = (own.transpose() * w).dot(w) / w.squaredNorm();
  }
  const auto right = dual_modes(own, result.left, values);
  if (!right) return {};
  result.right = *right;

  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - result.right * result.left.transpose();
  const std::optional<double> growth = largest_power(own * rest / values[2]);
  if (!growth) return {};

  constexpr int cuts = 3;
  double least = std::numeric_limits<double>::infinity(), largest = 0, norm = 0;
  for (std::size_t k = 0; k < children.size(); ++k) {
    if (static_cast<int>(k) == corner) continue;
    const Eigen::MatrixXd to_bezier = children[k].bezier * children[k].split;
    Regular piece;
    for (std::size_t i = 0; i < piece.b.size(); ++i)
      piece.b[i] << (to_bezier.row(static_cast<Eigen::Index>(i)) * result.right.rightCols<2>()).transpose(), 0;
    least = std::min(least, least_jacobian(piece, cuts));
    const auto bound = JacobianBound<Regular>::of(piece);
    largest = std::max(largest, bound.largest_du + bound.largest_dv);
    norm = std::max(norm, derivative_norm<Regular>(to_bezier));
  }
  if (!(least > same * largest * largest)) return {};
  // (du + e) x (dv + e') >= least - largest norm r - (norm r)^2 for rows of length r: its positive root.
  const double r = (std::sqrt(largest * largest + 4 * least) - largest) / (2 * norm);
  result.tolerance = (1 - 1e-6) * r / *growth;
  return result;
}

template std::optional<CornerRegularity> corner_regularity<BezierQuad>(const std::vector<RingChild>&, int,
                                                                       const LimitRows&);
template std::optional<CornerRegularity> corner_regularity<BezierTriangle>(const std::vector<RingChild>&, int,
                                                                           const LimitRows&);

}  // namespace shaolin
