#pragma once
/// The neighbourhood of one vertex, refined as deep as a parameter near it asks.
#include <array>
#include <map>
#include <vector>

#include "tools/validate/bfr_patch.h"

namespace shaolin {

/// Level k holds the three rings of faces around the vertex's child after k steps. One step cuts two rings out, refines
/// them (that determines three rings of the children completely, with all tags) and cuts these out again, so k levels
/// cost k small refinements. Where pieces may be refined further (see Piece) it is one ring more. Points are stored
/// relative to the vertex: normals keep their digits however small the rings become.
class CornerChain {
 public:
  /// The deepest refinement: parameters within 2^-max_level of the vertex count as the vertex itself.
  static constexpr int max_level = 120;

  /// `wide` keeps the ring more; give may_need_children() of the mesh.
  CornerChain(const TaggedMesh& mesh, const SubdivisionRules& rules, int vertex, bool wide,
              OpenSubdiv::Bfr::SurfaceFactoryCache& cache);

  /// The surface on the corner child of the given face after `level` steps, at (u, v) of that child in the face's own
  /// frame (its first vertex is the origin). (u, v) must lie outside the child's own corner child. The derivatives are
  /// per unit of the original face's u, v. The cost is that of the levels that are new, then of one small patch.
  SurfaceValues evaluate(int face, int corner, int level, double u, double v);

  /// The number of faces held in all levels: what the chain costs in memory, about 250 bytes each.
  std::size_t size() const { return size_; }

 private:
  /// A face at the vertex and which of its corners the vertex is.
  using Corner = std::pair<int, int>;

  struct Level {
    TaggedMesh mesh;
    int centre = 0;
    Vec3 origin;                                  // what to add to this level's points
    std::vector<std::array<int, 4>> cells;        // per corner: the children of the previous level's corner face
    std::map<std::pair<int, int>, Piece> pieces;  // per corner and child
  };

  int corner_face(const Level& level, std::size_t corner) const;
  void grow();
  Piece& piece(Level& level, int corner, int child);

  SubdivisionRules rules_;
  OpenSubdiv::Bfr::SurfaceFactoryCache& cache_;
  int rings_;                    // of a level; a step cuts out one less
  std::vector<Corner> corners_;  // in the original mesh
  std::vector<int> base_faces_;  // the same faces in level 0's mesh
  std::vector<Level> levels_;
  std::size_t size_ = 0;
};

}  // namespace shaolin
