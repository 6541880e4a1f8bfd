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
std::optional<FlatNet> flat_net(const std::vector<Eigen::MatrixXd>& splits);

extern template std::optional<FlatNet> flat_net<FaceKind::triangle>(const std::vector<Eigen::MatrixXd>&);
extern template std::optional<FlatNet> flat_net<FaceKind::quad>(const std::vector<Eigen::MatrixXd>&);

}  // namespace shaolin
