#pragma once
/// The control mesh as it was given: points, faces, sharpness tags. It knows no scheme and no half-edges.
#include <string>
#include <vector>

#include "polygon_mesh.h"

namespace shaolin {

/// What happens at a boundary (OpenSubdiv's VtxBoundaryInterpolation, numbered as in `t interpolateboundary`).
enum class BoundaryInterpolation {
  none = 0,             ///< faces at a boundary that is not sharpened have no limit surface
  edge_and_corner = 1,  ///< boundary edges are infinitely sharp, and so are vertices with one face
  edge_only = 2         ///< boundary edges are infinitely sharp
};

/// How the sharpness of a semi-sharp edge decays from level to level.
enum class CreaseMethod { uniform, chaikin };

/// Weights of edge points beside triangles in Catmull-Clark's first step.
enum class TriangleSubdivision { catmark, smooth };

/// Sharpness from here on is infinite (OpenSubdiv's SHARPNESS_INFINITE).
inline constexpr float infinite_sharpness = 10.0f;

/// Sharpness values are float, as OpenSubdiv stores them: the same file then gives the same surface to rounding.
struct SharpEdge {
  int a, b;
  float sharpness;
};
struct SharpVertex {
  int vertex;
  float sharpness;
};

/// Points, faces and tags, with the input's indices (all counted from 0).
struct ControlMesh : PolygonMesh {
  std::vector<SharpEdge> sharp_edges;
  std::vector<SharpVertex> sharp_vertices;
  std::vector<int> cones;  ///< vertices that keep a tangent cone where the smooth rule would give a tangent plane
  std::vector<int> holes;  ///< faces that shape their neighbours and have no surface themselves
  BoundaryInterpolation boundary = BoundaryInterpolation::edge_and_corner;
  CreaseMethod crease_method = CreaseMethod::uniform;
  TriangleSubdivision triangle_subdivision = TriangleSubdivision::catmark;
  std::string scheme;  ///< the file's `t scheme` hint; empty if it has none

  /// What is odd but usable, one sentence each, with file and line where known: isolated vertices, a vertex repeated
  /// in a face, neighbours wound against each other, creases on edges that do not exist.
  std::vector<std::string> warnings;

  bool all_triangles() const;

  /// Fewer than three of the face's sides join different vertices: it is a segment or a point, without a normal. O(its
  /// size).
  bool is_collapsed(int face) const;

  /// The length of the diagonal of the control points' bounding box: the length unit of error reports.
  double diagonal() const;
};

/// Checks a mesh that did not come from a file: indices in range, at least 3 corners a face, finite points, sharpness
/// not negative and not NaN, at least one face. Appends warnings. Throws InputError that names the element. O(size).
void check(ControlMesh& mesh);

}  // namespace shaolin
