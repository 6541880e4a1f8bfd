#pragma once
/// The new points of one refinement step. Mesh hierarchy and patch both call these, so that they agree to the last bit.
#include "scheme.h"
#include "sharpness.h"
#include "symmetric_sum.h"

namespace shaolin {

/// The new point inside a face: the mean of its corners.
inline Vec3 face_point(const PointGather& corners) { return symmetric_sum(corners) / corners.count; }

/// The new point of an edge: `crease_share` of its midpoint, the rest of the smooth mask (see
/// edge_crease_share()). `left` and `right` are the
/// new points of its faces (quad split) or the opposite vertices (triangles); they are not read where the share is 1.
inline Vec3 edge_point(const EdgeMask& mask, float crease_share, const Vec3& a, const Vec3& b, const Vec3* left,
                       const Vec3* right) {
  const Vec3 ends = a + b;
  if (crease_share == 1) return 0.5 * ends;
  const Vec3 smooth = mask.end * ends + mask.side * (*left + *right);
  if (crease_share <= 0) return smooth;
  return static_cast<double>(crease_share) * (0.5 * ends) + (1 - static_cast<double>(crease_share)) * smooth;
}

/// The point of a vertex by one rule. `spokes` are the neighbours, `faces` the new face points around (quads only).
inline Vec3 vertex_point_by(VertexRule rule, const std::array<int, 2>& ends, const VertexMask& mask,
                            const CreaseMask& crease, const Vec3& vertex, const PointGather& spokes,
                            const PointGather& faces) {
  switch (rule) {
    case VertexRule::corner:
      return vertex;
    case VertexRule::crease:
      return crease.vertex * vertex + crease.edge * (spokes[ends[0]] + spokes[ends[1]]);
    default:
      break;
  }
  Vec3 sum = mask.vertex * vertex + mask.edge * symmetric_sum(spokes);
  if (mask.face != 0) sum += mask.face * symmetric_sum(faces);
  return sum;
}

/// The new point of a vertex: both rules of its transition, blended.
inline Vec3 vertex_point(const VertexTransition& rule, const VertexMask& mask, const CreaseMask& crease,
                         const Vec3& vertex, const PointGather& spokes, const PointGather& faces) {
  const Vec3 parent = vertex_point_by(rule.parent, rule.parent_crease, mask, crease, vertex, spokes, faces);
  if (rule.parent_weight >= 1) return parent;
  const Vec3 child = vertex_point_by(rule.child, rule.child_crease, mask, crease, vertex, spokes, faces);
  const double share = rule.parent_weight;
  return share * parent + (1 - share) * child;
}

}  // namespace shaolin
