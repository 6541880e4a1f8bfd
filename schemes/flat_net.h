#pragma once
/// The net of points on which a configuration's surface is the plane of its parameters.
#include <optional>
#include <vector>

#include "domain.h"

namespace shaolin {

/// A place (u, v) for every control point, such that any affine map of the places refines to the same map of the
/// children's places: a patch whose points are l(place) for an affine l has the surface l(u, v). A scheme that keeps
/// planes has such a net wherever the neighbourhood is that of a regular lattice.
using FlatNet = std::vector<Parameter>;

/// The places, if there are any, by least squares: the corners are the domain's, and each split S_k gives
/// S_k places = (the child's places in the parent's domain). For configurations whose children all are of the same
/// configuration. `splits` are the matrices of the children. Empty if 1e-11 is not met. O(points^3).
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

}  // namespace shaolin
