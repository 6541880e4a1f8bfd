#include "tools/cli/mask_tables.h"

#include <cstdio>
#include <string>

namespace shaolin {
namespace {

const char* patches_of(Basis basis) {
  switch (basis) {
    case Basis::spline:
      return "splines where regular";
    case Basis::linear:
      return "linear patches";
    case Basis::none:
      break;
  }
  return "found by refinement alone";
}

void print_ring(const std::string& heading, const RingMask& mask) {
  std::printf("  %-8s  %11.8f ", heading.c_str(), mask.vertex);
  for (const double weight : mask.edges) std::printf(" %11.8f", weight);
  if (!mask.diagonals.empty()) std::printf("\n  %-8s  %11s ", "", "diagonals");
  for (const double weight : mask.diagonals) std::printf(" %11.8f", weight);
  std::printf("\n");
}

/// Radius 1.
void print_edge_mask(const SchemeMasks& masks) {
  const EdgeMask edge = masks.smooth_edge();
  std::printf("edge mask:    each end %.8f, each %s %.8f\n", edge.end,
              masks.face_kind() == FaceKind::quad ? "new face point" : "opposite vertex", edge.side);
}

/// Radius 2: an end of every valence against a regular one, and against one like itself where that differs.
void print_edge_ends(const SchemeMasks& masks) {
  const bool quads = masks.face_kind() == FaceKind::quad;
  const int regular = quads ? 4 : 6;
  const auto same = [](const RingMask& a, const RingMask& b) {
    return a.vertex == b.vertex && a.edges == b.edges && a.diagonals == b.diagonals;
  };
  const auto print = [&](int n, int other) {
    print_ring(std::to_string(n) + " to " + std::to_string(other), masks.edge_end(n, other));
  };
  std::printf(
      "\nedge mask: what an end of valence n gives if the other end has valence m; an edge point is the sum over\n"
      "both ends. The vertex, its spokes from the edge on%s\n\n  n to m\n",
      quads ? ", and diagonals from beside the edge on" : "");
  for (const int n : {3, 4, 5, 6, 7, 8}) {
    print(n, regular);
    const int irregular = n == regular ? 5 : n;
    if (!same(masks.edge_end(n, irregular), masks.edge_end(n, regular))) print(n, irregular);
  }
  if (!quads) return;
  std::printf(
      "\nface mask: what a corner of valence n gives. The vertex, its spokes from the face's first side on, and\n"
      "diagonals from the face's own on\n\n  n\n");
  for (const int n : {3, 4, 5, 6, 7, 8}) print_ring(std::to_string(n), masks.face_corner(n));
}

void print_vertex_masks(const SchemeMasks& masks) {
  const bool quads = masks.face_kind() == FaceKind::quad, limits = masks.has_closed_limits();
  std::printf("\nvertex masks: the vertex, each of n neighbours%s\n", quads ? ", each of n new face points" : "");
  if (limits)
    std::printf("limit masks:  the vertex, each of n neighbours%s\n", quads ? ", each of n diagonals" : "");
  else
    std::printf("limit masks:  no closed form; they are derived from the subdivision matrix\n");
  std::printf("\n  %3s  %-34s%s\n", "n", "refinement", limits ? "  limit" : "");
  for (const int n : {3, 4, 5, 6, 7, 8, 12, 20}) {
    const VertexMask vertex = masks.smooth_vertex(n);
    std::printf("  %3d  %10.8f  %10.8f", n, vertex.vertex, vertex.edge);
    if (quads) std::printf("  %10.8f", vertex.face);
    if (limits) {
      const LimitMask limit = masks.smooth_limit(n);
      std::printf("%s%10.8f  %10.8f", quads ? "  " : "              ", limit.vertex, limit.edge);
      if (quads) std::printf("  %10.8f", limit.diagonal);
    }
    std::printf("\n");
  }
}

}  // namespace

const char* faces_of(FaceKind kind) { return kind == FaceKind::triangle ? "triangles" : "quads"; }

void print_crease_rules(const LoadedPlugin& scheme) {
  const CreaseMask crease = scheme.masks->crease();
  std::printf("crease mask:  the vertex %.8f, each neighbour %.8f; limit %.8f, %.8f\n", crease.vertex, crease.edge,
              crease.limit_vertex, crease.limit_edge);
  if (!scheme.has_crease) std::printf("              no crease rules: the cubic B-spline curve's are used\n");
}

void print_masks(const LoadedPlugin& scheme) {
  const SchemeMasks& masks = *scheme.masks;
  std::printf("%s: on %s, %s\n\n", scheme.name.c_str(), faces_of(masks.face_kind()), patches_of(masks.basis()));
  if (masks.radius() == 1) print_edge_mask(masks);
  print_crease_rules(scheme);
  if (masks.radius() == 2) print_edge_ends(masks);
  print_vertex_masks(masks);
}

}  // namespace shaolin
