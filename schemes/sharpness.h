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

/// The sharpness of a vertex, one level finer, and under uniform decay of both halves of an edge: infinite stays, the
/// rest loses 1 until it is smooth. Exact in float: for s in (1, 10) the difference needs no more bits than s.
inline float decayed(float sharpness) {
  if (is_infinite(sharpness)) return infinite_sharpness;
  return sharpness > 1 ? sharpness - 1 : 0;
}

/// The semi-sharp edges around a vertex, as far as the decay of one of them asks: none under uniform decay.
///
/// Their sum is exact in double: a semi-sharp value is below 10 and has 24 bits. So it does not depend on the order of
/// the walk, and patches that share a vertex agree.
class SemiSharpEdges {
 public:
  explicit SemiSharpEdges(CreaseMethod method) : method_(method) {}
  void add(float sharpness) {
    if (method_ == CreaseMethod::uniform || !is_semi_sharp(sharpness)) return;
    sum_ += static_cast<double>(sharpness);
    ++count_;
  }

  /// The sharpness, one level finer, of the half at this vertex of one of its edges. Chaikin's rule (DeRose, Kass and
  /// Truong 1998, in OpenSubdiv's form): 3/4 of its own and 1/4 of the mean of the vertex's other semi-sharp edges,
  /// less 1. An edge that is the only one decays uniformly.
  float decayed(float sharpness) const {
    if (count_ < 2 || !is_semi_sharp(sharpness)) return shaolin::decayed(sharpness);
    const float others = static_cast<float>(sum_ - static_cast<double>(sharpness)) / static_cast<float>(count_ - 1);
    const float mixed = 0.75f * sharpness + 0.25f * others;
    return mixed > 1 ? mixed - 1 : 0;
  }

 private:
  CreaseMethod method_;
  double sum_ = 0;
  int count_ = 0;
};

/// True for the rules that read the whole ring.
inline bool is_smooth_rule(VertexRule rule) { return rule == VertexRule::smooth || rule == VertexRule::dart; }

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

/// The transition at a vertex, from the sharpness of its edges and that of their halves at the vertex, one level finer.
/// The blend weight is the mean of the sharpness values that decay to zero in this step,
/// at most 1. O(edges).
VertexTransition vertex_transition(float vertex_sharpness, std::span<const float> edge_sharpness,
                                   std::span<const float> half_sharpness);

/// The share of the crease rule in an edge's new point; the rest is the smooth rule's: 1 if both halves stay sharp,
/// else the sharpness. Under uniform decay halves stay sharp above 1 only. Under Chaikin's rule one of them may end
/// although the sharpness is above 1; then OpenSubdiv's refinement takes a share above 1, and so do we. (Its comments
/// speak of clamping, which its code does not do.)
inline float edge_crease_share(float sharpness, float half, float other_half) {
  if (is_infinite(sharpness) || (is_sharp(half) && is_sharp(other_half))) return 1;
  return is_sharp(sharpness) ? sharpness : 0;
}

}  // namespace shaolin
