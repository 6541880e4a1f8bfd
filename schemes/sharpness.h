#pragma once
/// Sharpness: which rule applies at a vertex or an edge, and how sharpness decays. It knows no scheme and no points.
///
/// The rules are those of Hoppe et al. 1994 (infinitely sharp) and DeRose, Kass and Truong 1998 (semi-sharp), in the
/// form that OpenSubdiv gave them: a vertex whose rule changes between a level and the next blends both rules.
#include <array>
#include <span>

#include "control_mesh.h"

namespace shaolin {

enum class VertexRule { smooth, dart, crease, corner };

inline bool is_sharp(float sharpness) { return sharpness > 0; }
inline bool is_infinite(float sharpness) { return sharpness >= infinite_sharpness; }
inline bool is_semi_sharp(float sharpness) { return is_sharp(sharpness) && !is_infinite(sharpness); }

/// The sharpness of a vertex, or of both halves of an edge, one level finer (uniform decay): infinite stays, the rest
/// loses 1 until it is smooth. Exact in float: for s in (1, 10) the difference needs no more bits than s.
inline float decayed(float sharpness) {
  if (is_infinite(sharpness)) return infinite_sharpness;
  return sharpness > 1 ? sharpness - 1 : 0;
}

/// The rule at a vertex of the given sharpness among its edges: a sharp vertex is a corner; otherwise no sharp edge is
/// smooth, one a dart, two a crease, more a corner.
VertexRule vertex_rule(float vertex_sharpness, std::span<const float> edge_sharpness);

/// How a vertex goes to the next level: parent_weight x (rule `parent`) + (1 - parent_weight) x (rule `child`).
/// The weight is 1 if both rules agree. The crease ends are places among the vertex's edges, valid for a crease rule.
struct VertexTransition {
  VertexRule parent = VertexRule::smooth;
  VertexRule child = VertexRule::smooth;
  float parent_weight = 1;
  std::array<int, 2> parent_crease{0, 0};
  std::array<int, 2> child_crease{0, 0};
};

/// The transition at a vertex. The blend weight is the mean of the sharpness values that decay to zero in this step,
/// at most 1. O(edges).
VertexTransition vertex_transition(float vertex_sharpness, std::span<const float> edge_sharpness);

/// The share of the crease rule in an edge's new point; the rest is the smooth rule's: sharpness clamped to [0, 1].
inline float edge_crease_share(float sharpness) { return sharpness >= 1 ? 1.0f : sharpness > 0 ? sharpness : 0.0f; }

}  // namespace shaolin
