#pragma once
/// The limit surface exactly at a vertex of the mesh.
#include "tools/validate/tagged_mesh.h"

namespace shaolin {

/// The limit position, and the unit normal of one face's side of the surface there (along du x dv). The normal is zero
/// where the limit has no tangent plane or none that subdivision theory decides: interior valence 2, a sharp corner
/// between several faces, a crease whose side has so many faces that its second oscillating mode wins over the
/// derivative along the crease (Catmull-Clark from 4, Loop from 6).
struct CornerLimit {
  Vec3 position, normal;
};

/// The limit at corner `corner` of `face`, a face of the scheme's own kind. OpenSubdiv refines until the tags around
/// the vertex are stationary; then its refinement weights, taken as a matrix over the 1-ring, are applied until the
/// ring contracts to the limit. OpenSubdiv's limit masks serve for normals at smooth vertices alone: for darts they
/// are those of a smooth vertex, and for interior valence 2 those of a corner, both wrong.
/// O(valence x 100), for darts and creases O(valence^3).
CornerLimit corner_limit(const TaggedMesh& mesh, const SubdivisionRules& rules, int face, int corner);

/// The faces around a corner of a face that are joined by edges that are not infinitely sharp, or by manifold edges
/// whatever their sharpness, counter-clockwise.
struct Sector {
  std::vector<int> faces, corners;  ///< and which of the face's corners the vertex is
  bool closed = false;              ///< they go around the vertex

  int size() const { return static_cast<int>(faces.size()); }
};
Sector sector_around(const TaggedMesh& mesh, int face, int corner, bool across_creases = false);

/// The number of infinitely sharp edges at a vertex; boundaries and non-manifold edges count.
int crease_count(const TaggedMesh& mesh, int vertex);

}  // namespace shaolin
