#include "limit_rows.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace shaolin {

namespace {

/// Eigenvalues nearer than this are one that rounding has parted: eigenvalues of non-normal matrices of some hundred
/// rows come with errors up to 1e-12, those of different Fourier modes are more than 1e-5 apart up to valence 1,000.
constexpr double same = 1e-9;

/// An orthonormal basis of the left eigenvectors of an eigenvalue of multiplicity `count`. (Better than the
/// eigenvectors that come with the eigenvalues, which lose half their digits where two coincide.)
Eigen::MatrixXd left_eigenvectors(const Eigen::MatrixXd& matrix, double eigenvalue, int count) {
  const Eigen::Index n = matrix.rows();
  return null_space(matrix.transpose() - eigenvalue * Eigen::MatrixXd::Identity(n, n), count);
}

/// The ring around the origin of a plane, counter-clockwise: spokes at distance 1, diagonals (of quads) between them.
Eigen::Matrix<double, Eigen::Dynamic, 2> flat_layout(const Ring& ring, Eigen::Index points) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> layout = Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(points, 2);
  const double step = (ring.closed ? 2 : 1) * std::numbers::pi / static_cast<double>(ring.faces.size());
  const auto put = [&](int vertex, double angle, double distance) {
    if (vertex != ring.vertex) layout.row(vertex) << distance * std::cos(angle), distance * std::sin(angle);
  };
  for (std::size_t i = 0; i < ring.faces.size(); ++i)
    if (ring.faces[i].size() == 4) put(ring.faces[i].vertex(2), (static_cast<double>(i) + 0.5) * step, std::sqrt(2));
  for (std::size_t i = 0; i < ring.spokes.size(); ++i) put(ring.spokes[i].end, static_cast<double>(i) * step, 1);
  return layout;
}

}  // namespace

Eigen::MatrixXd matrix_of(const SplitProgram& program, int parent_points) {
  std::vector<Vec3> parent(static_cast<std::size_t>(parent_points)),
      child(static_cast<std::size_t>(program.point_count()));
  Eigen::MatrixXd matrix(program.point_count(), parent_points);
  for (int first = 0; first < parent_points; first += 3) {
    const int columns = std::min(3, parent_points - first);
    for (Vec3& point : parent) point.setZero();
    for (int axis = 0; axis < columns; ++axis) parent[static_cast<std::size_t>(first + axis)][axis] = 1;
    program.run(parent.data(), child.data());
    for (int row = 0; row < program.point_count(); ++row)
      matrix.row(row).segment(first, columns) = child[static_cast<std::size_t>(row)].head(columns);
  }
  return matrix;
}

std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXcd found = matrix.eigenvalues();
  std::vector<std::complex<double>> sorted(found.begin(), found.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return sorted;
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& matrix, int count) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix.transpose());
  const Eigen::MatrixXd rotation = qr.householderQ();
  return rotation.rightCols(count);
}

LimitAtCorner LimitRows::at(std::span<const Vec3> points) const {
  const auto sum = [&](const auto& mask) {
    Vec3 total = Vec3::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) total += mask[static_cast<Eigen::Index>(i)] * points[i];
    return total;
  };
  LimitAtCorner limit{sum(position), {}};
  if (tangents) limit.normal = sum(tangents->col(0)).cross(sum(tangents->col(1))).normalized();
  return limit;
}

std::optional<LimitRows> limit_rows(const Eigen::MatrixXd& matrix, const Ring& ring) {
  const std::vector<std::complex<double>> values = eigenvalues(matrix);
  if (values.empty() || std::abs(values[0] - 1.0) > same) return {};
  if (values.size() > 1 && std::abs(values[1]) > 1 - same) return {};

  LimitRows rows;
  rows.position = left_eigenvectors(matrix, 1, 1);
  rows.position /= rows.position.sum();
  if (values.size() < 3) return rows;
  const auto is_positive = [](const std::complex<double>& value) {
    return value.real() > same && std::abs(value.imag()) <= same;
  };
  const double next = values.size() > 3 ? std::abs(values[3]) : 0;
  if (!is_positive(values[1]) || !is_positive(values[2]) || values[2].real() <= next + same) return rows;

  const double first = values[1].real(), second = values[2].real();
  const auto pair = [&](const Eigen::MatrixXd& m) {
    Eigen::Matrix<double, Eigen::Dynamic, 2> vectors(m.rows(), 2);
    if (first - second <= same) {
      vectors = left_eigenvectors(m, (first + second) / 2, 2);
    } else {
      vectors.col(0) = left_eigenvectors(m, first, 1);
      vectors.col(1) = left_eigenvectors(m, second, 1);
    }
    return vectors;
  };
  Eigen::Matrix<double, Eigen::Dynamic, 2> tangents = pair(matrix);
  // The right eigenvectors are the net that the tangents span; it is laid out as the ring is, or mirrored.
  const Eigen::Matrix<double, Eigen::Dynamic, 2> net = pair(matrix.transpose());
  const double orientation =
      (tangents.transpose() * net).determinant() * (flat_layout(ring, matrix.rows()).transpose() * net).determinant();
  if (orientation < 0) tangents.col(1) *= -1;
  if (orientation != 0) rows.tangents = tangents;
  return rows;
}

}  // namespace shaolin
