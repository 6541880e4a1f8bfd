#include "flat_net.h"

#include <Eigen/QR>

namespace shaolin {

template <FaceKind kind>
std::optional<FlatNet> flat_net(const std::vector<Eigen::MatrixXd>& splits) {
  using D = Domain<kind>;
  const Eigen::Index n = splits.front().cols(), corners = D::corner_count;
  Eigen::MatrixXd equations = Eigen::MatrixXd::Zero(corners + n * static_cast<Eigen::Index>(splits.size()), n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(equations.rows(), 2);
  for (Eigen::Index k = 0; k < corners; ++k) {
    equations(k, k) = 1;
    right.row(k) << D::corners[static_cast<std::size_t>(k)][0], D::corners[static_cast<std::size_t>(k)][1];
  }
  for (std::size_t k = 0; k < splits.size(); ++k) {
    const Eigen::Index row = corners + n * static_cast<Eigen::Index>(k);
    const int child = static_cast<int>(k);
    equations.middleRows(row, n) = splits[k] - D::scale(child) * Eigen::MatrixXd::Identity(n, n);
    right.middleRows(row, n).rowwise() = D::to_parent(child, Parameter::Zero()).transpose();
  }
  const Eigen::MatrixXd places = equations.colPivHouseholderQr().solve(right);
  if (!((equations * places - right).cwiseAbs().maxCoeff() < 1e-11)) return {};
  FlatNet net;
  for (Eigen::Index i = 0; i < n; ++i) net.emplace_back(places(i, 0), places(i, 1));
  return net;
}

template std::optional<FlatNet> flat_net<FaceKind::triangle>(const std::vector<Eigen::MatrixXd>&);
template std::optional<FlatNet> flat_net<FaceKind::quad>(const std::vector<Eigen::MatrixXd>&);

}  // namespace shaolin
