#include "limit_bound.h"

#include <algorithm>
#include <limits>

#include "limit_rows.h"

namespace shaolin {

Descent descent(const Eigen::MatrixXd& matrix, int child) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!((matrix.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-9)) return {child, infinity, infinity};
  const Eigen::RowVectorXd mean = matrix.colwise().mean();
  return {child, mean.lpNorm<1>(), (matrix.rowwise() - mean).rowwise().lpNorm<1>().maxCoeff()};
}

std::vector<double> limit_bounds(const std::vector<std::vector<Descent>>& descents) {
  double most = 1, widest = 0;
  for (const auto& from : descents)
    for (const Descent& way : from) most = std::max(most, way.mean_norm), widest = std::max(widest, way.spread);
  const double start = widest < 1 ? most / (1 - widest) : std::numeric_limits<double>::infinity();
  std::vector<double> bounds(descents.size(), start);
  // Every sweep keeps bounds that hold; ten bring them within (3/4)^10 of the fixed point.
  for (int sweep = 0; sweep < 10; ++sweep)
    for (std::size_t i = 0; i < descents.size(); ++i) {
      double bound = 1;
      for (const Descent& way : descents[i])
        bound = std::max(bound, way.mean_norm + way.spread * bounds[static_cast<std::size_t>(way.child)]);
      bounds[i] = std::min(bounds[i], bound);
    }
  return bounds;
}

Eigen::MatrixXd split_product(const SplitProgram& program, const Eigen::MatrixXd& before) {
  const Eigen::MatrixXd split = matrix_of(program, static_cast<int>(before.rows()));
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(split.rows(), before.cols());
  for (Eigen::Index row = 0; row < split.rows(); ++row)
    for (Eigen::Index i = 0; i < split.cols(); ++i)
      if (split(row, i) != 0) product.row(row) += split(row, i) * before.row(i);
  return product;
}

}  // namespace shaolin
