#include "sharpness.h"

#include <algorithm>

namespace shaolin {

namespace {

std::array<int, 2> crease_ends(std::span<const float> edge_sharpness) {
  const auto first = std::find_if(edge_sharpness.begin(), edge_sharpness.end(), is_sharp);
  const auto second = std::find_if(first + 1, edge_sharpness.end(), is_sharp);
  return {static_cast<int>(first - edge_sharpness.begin()), static_cast<int>(second - edge_sharpness.begin())};
}

}  // namespace

VertexRule vertex_rule(float vertex_sharpness, std::span<const float> edge_sharpness) {
  if (is_sharp(vertex_sharpness)) return VertexRule::corner;
  const auto sharp_edges = std::count_if(edge_sharpness.begin(), edge_sharpness.end(), is_sharp);
  return static_cast<VertexRule>(std::min<std::ptrdiff_t>(sharp_edges, 3));
}

VertexTransition vertex_transition(float vertex_sharpness, std::span<const float> edge_sharpness,
                                   std::span<const float> child_edges) {
  VertexTransition result;
  result.parent = result.child = vertex_rule(vertex_sharpness, edge_sharpness);
  if (is_smooth_rule(result.parent)) return result;
  if (result.parent == VertexRule::crease) result.parent_crease = crease_ends(edge_sharpness);

  const float child_vertex = decayed(vertex_sharpness);
  result.child = vertex_rule(child_vertex, child_edges);
  if (result.child == result.parent) {
    result.child_crease = result.parent_crease;
    return result;
  }
  if (result.child == VertexRule::crease) result.child_crease = crease_ends(child_edges);

  int ending = 0;
  float sum = 0;
  if (is_sharp(vertex_sharpness) && !is_sharp(child_vertex)) {
    sum += vertex_sharpness;
    ++ending;
  }
  for (std::size_t i = 0; i < edge_sharpness.size(); ++i) {
    if (is_sharp(edge_sharpness[i]) && !is_sharp(child_edges[i])) {
      sum += edge_sharpness[i];
      ++ending;
    }
  }
  result.parent_weight = std::min(1.0f, sum / static_cast<float>(ending));
  return result;
}

}  // namespace shaolin
