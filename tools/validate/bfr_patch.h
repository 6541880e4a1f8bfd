#pragma once
/// One face of a mesh as OpenSubdiv's Bfr evaluates it, in double.
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/surfaceFactoryCache.h>

#include <array>
#include <memory>
#include <optional>

#include "tools/validate/tagged_mesh.h"

namespace shaolin {

/// Position and derivatives, before a normal is made of them.
struct SurfaceValues {
  Vec3 position, du, dv, duu, duv, dvv;

  /// Derivatives per unit of a parameter that is `factor` times coarser.
  void rescale(double factor);
};

/// Owns the control points it needs; the mesh may go away. Both approximation levels are 10: the pieces down to
/// 2^-10 of the face are exact, smaller ones at an irregular corner are Bfr's end-caps and are not to be evaluated.
class BfrPatch {
 public:
  /// Builds the surface of a regular-size face (a quad for Catmull-Clark) whose neighbourhood is complete in `mesh`.
  /// The cache shares irregular topologies. Throws std::runtime_error if Bfr has no surface there.
  BfrPatch(const TaggedMesh& mesh, int face, const SubdivisionRules& rules,
           OpenSubdiv::Bfr::SurfaceFactoryCache& cache);

  /// Bfr's own frame: the origin at the face's first vertex, u along its first edge.
  SurfaceValues evaluate(double u, double v) const;

 private:
  SurfaceValues as_bfr_says(double u, double v) const;

  bool triangular_;
  OpenSubdiv::Bfr::Surface<double> surface_;
  std::vector<double> points_;  // relative to origin_: what is far from the world's origin keeps its digits
  Vec3 origin_;
};

/// A face by Bfr where Bfr is right, by its children where it is not: on semi-sharp creases under Chaikin's rule. There
/// the sharpness of a child edge depends on edges two rings away, which Bfr's 1-ring does not hold; OpenSubdiv 3.5 is
/// off by 1e-6 to 1e-3 of the face. With refinement the sharpness decays to 0.
class Piece {
 public:
  /// The face's 2-ring must be complete in `mesh` where this may happen (see may_need_children()), else its 1-ring.
  Piece(const TaggedMesh& mesh, int face, const SubdivisionRules& rules, OpenSubdiv::Bfr::SurfaceFactoryCache& cache);

  /// In the face's frame, per unit of its u and v.
  SurfaceValues evaluate(double u, double v);

 private:
  void split();

  SubdivisionRules rules_;
  OpenSubdiv::Bfr::SurfaceFactoryCache& cache_;
  std::optional<BfrPatch> patch_;
  TaggedMesh surroundings_;  // the 2-ring, and this face in it; until it is split
  int face_ = 0;
  std::array<std::unique_ptr<Piece>, 4> children_;
};

/// True if any face of the mesh, or of its refinements, may be one that Bfr gets wrong.
bool may_need_children(const TaggedMesh& mesh, const SubdivisionRules& rules);

}  // namespace shaolin
