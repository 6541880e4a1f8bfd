#pragma once
/// The limit surface to far more digits than double has: what exact hits are held against.
#include "tools/validate/mask_refinement.h"
#include "tools/validate/oracle.h"

namespace shaolin {

/// Refinement by the masks as in MaskOracle, in numbers of 113 bits, until the face that holds the parameter is a
/// point to 2^-90 of the diagonal. Weights of smooth vertices are exact to those digits for loop and catmark, all other
/// weights are short binary fractions; other schemes' are their doubles.
class QuadOracle {
 public:
  /// Throws InputError as MaskOracle does, and for masks of radius 2.
  QuadOracle(const ControlMesh& mesh, const std::string& scheme);

  /// The limit position. The face must have a limit surface. Not for concurrent use.
  QuadVec3 position(const SurfaceParameter& at) const;

  double diagonal() const { return root_.diagonal; }
  bool triangular() const { return root_.rules.triangular(); }

 private:
  RootMesh make_root(const ControlMesh& mesh);

  std::shared_ptr<const SchemeMasks> masks_;
  VertexWeightsOf<Quad> weights_;
  std::vector<QuadVec3> root_points_;  ///< of root_.mesh, before root_: its making fills them
  RootMesh root_;
};

}  // namespace shaolin
