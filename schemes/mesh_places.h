#pragma once
/// Where the elements of a control mesh stand in the file that they came from.
#include <string>
#include <vector>

#include "control_mesh.h"
#include "scheme.h"

namespace shaolin {

/// One line number (from 1) for each element; an empty list where no lines are known.
struct MeshPlaces {
  std::string file;
  std::vector<int> positions;
  std::vector<int> faces;
  std::vector<int> sharp_edges;
  std::vector<int> sharp_vertices;
  std::vector<int> cones;
  std::vector<int> holes;
  int scheme = 0;  ///< of the scheme's tag; 0: none
};

/// check() whose messages and warnings carry file and line. A warning that the mesh has already is not repeated.
void check(ControlMesh& mesh, const MeshPlaces& places);

/// Throws InputError, with file and line where known, if a scheme that splits faces of this kind cannot split a face of
/// the mesh: triangle schemes take triangles only, quad schemes any face. O(faces).
void check_faces(const ControlMesh& mesh, FaceKind kind, const MeshPlaces& places = {});

}  // namespace shaolin
