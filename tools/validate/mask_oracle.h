#pragma once
/// The limit surface of any scheme, by nothing but its masks, applied again and again.
#include <map>
#include <memory>

#include "schemes/runtime_scheme.h"
#include "tools/validate/oracle.h"

namespace shaolin {

/// Around a parameter the mesh is cut out and refined (see mask_refinement.h) until the face that holds the parameter
/// is a point. No limit masks, no bounds, no polynomials: slow, some 10 ms an evaluation, but there is little to be
/// wrong.
class MaskOracle final : public Oracle {
 public:
  /// Throws InputError for triangle masks over other faces and for meshes that OpenSubdiv declines. O(mesh size).
  MaskOracle(const ControlMesh& mesh, std::shared_ptr<const SchemeMasks> masks);

  bool has_derivatives() const override { return false; }
  /// The normal is that of the last faces around the parameter, zero if they have not settled, and at the apex of a
  /// cone. O(log2(1 / rounding) x faces within three rings); more where a surface shrinks by less than half a level.
  std::optional<LimitSample> evaluate(const SurfaceParameter& at) const override;

 private:
  std::shared_ptr<const SchemeMasks> masks_;
};

}  // namespace shaolin
