#pragma once
/// One step of a scheme that OpenSubdiv does not have: its topology and sharpness, a plain reading of the scheme's
/// masks.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <functional>

#include "schemes/runtime_scheme.h"
#include "tools/validate/tagged_mesh.h"

namespace shaolin {

/// One uniform step. OpenSubdiv splits the mesh and its tags (`rules` has the split of the masks' faces); the new
/// points are found from the masks point by point, as docs/schemes.md words the rules for sharpness, boundaries and
/// sectors, with none of the product's configurations, stencils or tables. Around a vertex that is not manifold (also
/// at the rim of a cut-out) points are those of a corner. O(size).
Refined refine(const TaggedMesh& mesh, const SubdivisionRules& rules, const SchemeMasks& masks);

/// Numbers of 113 bits.
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;
using QuadVec3 = Eigen::Matrix<Quad, 3, 1>;

/// VertexMask in any numbers.
template <class Scalar>
struct VertexWeights {
  Scalar vertex, edge, face;
};
/// Of a vertex of valence n whose mask is that of its whole ring.
enum class RingRule { smooth, dart, cone };
VertexMask vertex_mask(const SchemeMasks& masks, int n, RingRule rule);
template <class Scalar>
using VertexWeightsOf = std::function<VertexWeights<Scalar>(int n, RingRule rule)>;

/// The points of `fine`, which is refine(coarse), from points of `coarse` that are given as exactly. All weights are
/// the masks', which must be of radius 1, but for those of vertices.
std::vector<QuadVec3> refine_points(const TaggedMesh& coarse, const std::vector<QuadVec3>& points, const Refined& fine,
                                    const SubdivisionRules& rules, const SchemeMasks& masks,
                                    const VertexWeightsOf<Quad>& vertex_weights);

}  // namespace shaolin
