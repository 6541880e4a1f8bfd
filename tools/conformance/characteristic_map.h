#pragma once
/// The characteristic map (Reif 1995): the limit of the control net that the two subdominant eigenvectors span. If it
/// is regular and injective, the surface has a tangent plane at the vertex for almost all control points.
#include <vector>

#include <Eigen/Core>

#include "schemes/patch.h"
#include "schemes/runtime_scheme.h"
#include "tools/conformance/vertex_star.h"

namespace shaolin {

struct CharacteristicMap {
  int faces = 0;
  /// The least Jacobian over a dense grid of the ring (the sector less its quarter at the vertex), relative to the
  /// mean.
  double least_jacobian = 0;
  /// The angle that the sector's outer border sweeps, relative to the 2 pi / n that makes the ring close once.
  double sweep = 0;
  /// Lines of constant parameter through one sector, for drawing; the others are rotations.
  std::vector<std::vector<Eigen::Vector2d>> lines;

  bool is_injective() const { return least_jacobian > 0 && std::abs(sweep - 1) < 1e-6; }
};

/// Of a patch whose corner 0 is a smooth vertex and whose split there leads to its own configuration again; the ring is
/// laid out so that spoke i points towards (cos, sin)(2 pi i / n). Empty `faces` = 0 if there are no two equal real
/// subdominant eigenvalues.
template <FaceKind kind>
CharacteristicMap characteristic_map(const Patch<RuntimeScheme<kind>>& patch);

extern template CharacteristicMap characteristic_map(const Patch<RuntimeScheme<FaceKind::triangle>>&);
extern template CharacteristicMap characteristic_map(const Patch<RuntimeScheme<FaceKind::quad>>&);

}  // namespace shaolin
