#pragma once
/// Points and faces, and nothing else.
#include <span>
#include <vector>

#include "vec3.h"

namespace shaolin {

/// Faces are lists of vertices; face f has corners face_vertices[face_offsets[f] .. face_offsets[f + 1]).
struct PolygonMesh {
  std::vector<Vec3> positions;
  std::vector<int> face_offsets{0};
  std::vector<int> face_vertices;

  int face_count() const { return static_cast<int>(face_offsets.size()) - 1; }
  int face_size(int face) const { return face_offsets[face + 1] - face_offsets[face]; }
  std::span<const int> face(int face) const {
    return {face_vertices.data() + face_offsets[face], static_cast<std::size_t>(face_size(face))};
  }
  void add_face(std::span<const int> corners) {
    face_vertices.insert(face_vertices.end(), corners.begin(), corners.end());
    face_offsets.push_back(static_cast<int>(face_vertices.size()));
  }
};

}  // namespace shaolin
