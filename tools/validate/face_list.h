#pragma once
/// A mesh as OpenSubdiv's descriptors take it: faces by vertices, tags by vertices; edges are vertex pairs.
#include <opensubdiv/far/topologyRefiner.h>

#include <memory>
#include <vector>

#include "schemes/control_mesh.h"
#include "tools/validate/tagged_mesh.h"

namespace shaolin {

struct FaceList {
  std::vector<Vec3> points;
  std::vector<int> sizes, vertices;
  std::vector<SharpEdge> creases;
  std::vector<SharpVertex> corners;
  std::vector<int> holes;
};

/// The control mesh's lists. Creases on edges that it does not have are dropped: OpenSubdiv would print each.
FaceList face_list(const ControlMesh& mesh);

/// The 1-ring of a face unfolded, the face first: every place around it is a vertex of its own, even where the mesh
/// itself comes back to the same vertex (beside an interior vertex of valence 2, on a non-manifold edge's other side).
/// The face has the same surface in it, because that depends on the sequence of points and tags around each corner
/// alone. Its 1-ring must be complete in `mesh`.
FaceList unfolded_ring(const TaggedMesh& mesh, int face);

/// OpenSubdiv's refiner with these faces as its base level. Throws std::runtime_error if OpenSubdiv declines them.
std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const FaceList& mesh, const SubdivisionRules& rules);

}  // namespace shaolin
