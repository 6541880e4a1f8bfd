#pragma once
/// Cutting a control mesh into manifold pieces that half-edges can hold, with the sharpness that keeps the
/// surface as OpenSubdiv defines it.
#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "control_mesh.h"
#include "half_edges.h"

namespace shaolin {

/// Faces over cut vertices: every edge has at most two faces, in opposite directions, and every vertex one fan.
///
/// A non-manifold edge (more than two faces, two in the same direction, one face twice, or equal ends) is infinitely
/// sharp; sharp edges separate what lies on their sides, so cutting there changes nothing. A non-manifold vertex is a
/// corner, unless it has exactly two non-manifold edges, no boundary edge and more faces than edges (fins along a
/// crease). Boundary and corner rules look at the input's edges and faces, not at the pieces'.
struct ManifoldMesh {
  explicit ManifoldMesh(HalfEdges faces, std::vector<int> cut_from = {})
      : half_edges(std::move(faces)), origin(std::move(cut_from)) {}

  HalfEdges half_edges;                 ///< of the input's faces over cut vertices (repeats kept)
  std::vector<int> origin;              ///< cut vertex -> input vertex
  std::vector<float> vertex_sharpness;  ///< per cut vertex; boundary corners and cuts included
  std::vector<char> is_cone;            ///< per cut vertex
  std::vector<char> has_limit;          ///< per face: no hole, no uninterpolated boundary
  CreaseMethod crease_method = CreaseMethod::uniform;
  int cut_edges = 0;     ///< non-manifold edges of the input
  int cut_vertices = 0;  ///< vertices that fell into several pieces

  /// The sharpness of the edge between two cut vertices: the tag's, or infinite at a boundary or a cut.
  float edge_sharpness(int a, int b) const {
    const auto at = sharp_edges.find(edge_key(a, b));
    return at == sharp_edges.end() ? 0 : at->second;
  }
  static std::uint64_t edge_key(int a, int b) {
    const auto low = static_cast<std::uint32_t>(std::min(a, b)), high = static_cast<std::uint32_t>(std::max(a, b));
    return static_cast<std::uint64_t>(high) << 32 | low;
  }
  static std::array<int, 2> ends(std::uint64_t edge_key) {
    return {static_cast<int>(edge_key & 0xffffffff), static_cast<int>(edge_key >> 32)};
  }
  std::unordered_map<std::uint64_t, float> sharp_edges;
};

/// `faces_stand_alone`: nothing beyond a face shapes it, so that no boundary leaves it without a limit surface. Where
/// nothing is cut, half-edges are those of the mesh itself, which is shared. O(size log size).
ManifoldMesh cut_to_manifold(const std::shared_ptr<const ControlMesh>& mesh, bool faces_stand_alone = false);

}  // namespace shaolin
