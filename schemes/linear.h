#pragma once
/// The schemes that only cut faces up: linear on triangles, bilinear on quads and n-gons.
#include "scheme.h"

namespace shaolin {

/// What both have in common: vertices stay, edges are cut in the middle, and nothing beyond a face shapes it. The
/// surface is continuous and has no tangent planes at edges; sharpness makes no difference.
struct PolyhedralMasks {
  static constexpr Basis basis = Basis::linear;
  static constexpr CreaseMask crease = linear_crease;
  static constexpr Smoothness smoothness = continuous_surface;

  static VertexMask smooth_vertex(int) { return {1, 0, 0}; }
  static EdgeMask smooth_edge() { return {0.5, 0}; }
  static LimitMask smooth_limit(int) { return {1, 0, 0}; }
  static RingMask smooth_tangent(int, double) { return {}; }
  static RingMask crease_cross_tangent(int) { return {}; }
};

/// Triangles stay flat.
struct Linear : PolyhedralMasks {
  static constexpr const char* name = "linear";
  static constexpr FaceKind face_kind = FaceKind::triangle;
};

/// Quads are bilinear patches; an n-gon is cut into n quads at its centroid.
struct Bilinear : PolyhedralMasks {
  static constexpr const char* name = "bilinear";
  static constexpr FaceKind face_kind = FaceKind::quad;
};

static_assert(Scheme<Linear> && Scheme<Bilinear>);

}  // namespace shaolin
