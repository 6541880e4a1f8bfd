#include "affine.h"

#include <sstream>

#include "../schemes/errors.h"

namespace shaolin {

namespace {

/// 2^-e, with which a number of that magnitude comes to lie in [1/2, 1).
double to_unit(double magnitude) { return std::scalbn(1.0, -std::ilogb(magnitude) - 1); }

[[noreturn]] void fail(const char* what, double value) {
  std::ostringstream text;
  text << what << value << "; expected an invertible map";
  throw InputError(text.str());
}

}  // namespace

/// The determinant is a sum of six products of three entries of at most 1, with at most five roundings each: its error
/// stays below 30 u, that of a cofactor below 3 u. Beside 2^-30, the first is 3.6e-6 in relative terms.
Affine inverse(const Affine& map) {
  if (!map.matrix().allFinite()) throw InputError("the transform has an entry that is not finite");
  Eigen::Matrix3d scaled = map.linear();
  Vec3 rows, columns;
  const auto no_direction = [](double largest) { return !(largest >= std::numeric_limits<double>::min()); };
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double largest = scaled.row(i).cwiseAbs().maxCoeff();
    if (no_direction(largest)) fail("the transform is singular: its linear part has a row of size ", largest);
    rows[i] = to_unit(largest);
    scaled.row(i) *= rows[i];
  }
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double largest = scaled.col(i).cwiseAbs().maxCoeff();
    if (no_direction(largest)) fail("the transform is singular: its linear part has a column of size ", largest);
    columns[i] = to_unit(largest);
    scaled.col(i) *= columns[i];
  }
  const double determinant = scaled.determinant();
  if (!(std::abs(determinant) >= 0x1p-30))
    fail("the transform is singular to rounding: scaled to unit rows and columns its determinant is ", determinant);

  Affine result;
  result.linear() = columns.asDiagonal() * scaled.inverse() * rows.asDiagonal();
  result.translation() = -(result.linear() * map.translation());
  if (!result.matrix().allFinite()) throw InputError("the transform's inverse exceeds the range of numbers");
  return result;
}

/// Each coordinate of an image is a sum of four terms, which carry at most one rounding as products and three as
/// summands: 4 u of the sum of their magnitudes, to first order, and as much as the least normal number where products
/// underflow. Twice that covers higher orders and the roundings of the margin.
Box transformed(const Box& box, const Affine& map) {
  if ((box.lower.array() > box.upper.array()).any()) return {};
  Box image;
  for (Eigen::Index row = 0; row < 3; ++row) {
    double lower = map.translation()[row], upper = lower, magnitude = std::abs(lower);
    for (Eigen::Index column = 0; column < 3; ++column) {
      const double factor = map.linear()(row, column);
      const double a = factor * box.lower[column], b = factor * box.upper[column];
      lower += std::min(a, b);
      upper += std::max(a, b);
      magnitude += std::max(std::abs(a), std::abs(b));
    }
    const double margin = 8 * unit_roundoff * magnitude + std::numeric_limits<double>::min();
    image.lower[row] = lower - margin;
    image.upper[row] = upper + margin;
  }
  return image;
}

}  // namespace shaolin
