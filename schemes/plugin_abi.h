#pragma once
/// What a scheme in a shared library hands to its host, in plain C: one entry point, one struct. In C++ plugin.h fills
/// it from a scheme.

/// Changes whenever the structs below change; a host takes its own version only.
#define SHAOLIN_PLUGIN_VERSION 1

/// The values of shaolin_plugin.basis; see Basis in scheme.h.
enum { SHAOLIN_BASIS_NONE = 0, SHAOLIN_BASIS_SPLINE = 1, SHAOLIN_BASIS_LINEAR = 2 };

#ifdef __cplusplus
extern "C" {
#endif

/// Where a callback writes its answer.
typedef struct shaolin_weights {
  double* values;
  int capacity;        ///< of `values`
  char* error;         ///< for a text that ends in a zero byte, if the callback fails
  int error_capacity;  ///< the zero byte included
} shaolin_weights;

/// A callback writes at most `capacity` weights and returns how many there are, or -1 after writing an error. They are
/// called from any number of threads at once, and once per configuration of a mesh, never per ray.
typedef int (*shaolin_mask)(shaolin_weights* out);
typedef int (*shaolin_mask_of_valence)(int n, shaolin_weights* out);
typedef int (*shaolin_mask_of_edge)(int n, int other, shaolin_weights* out);
typedef int (*shaolin_mask_of_direction)(int n, double first, shaolin_weights* out);

/// A scheme. The masks mean what the members of the concept `Scheme` in scheme.h mean. "Ring(n)" is the vertex, n
/// spokes, and on quads n diagonals: 1 + n weights on triangles, 1 + 2 n on quads.
typedef struct shaolin_plugin {
  int version;           ///< SHAOLIN_PLUGIN_VERSION; stays the first member
  const char* name;      ///< for messages and reports
  int face_kind;         ///< 3: triangles into four, 4: faces into quads
  int radius;            ///< 1: smooth_edge is called, 2: edge_end is
  int basis;             ///< what regular patches are made of; anything but none needs radius 1
  int has_crease;        ///< 0: `crease` is not read and creases are cubic B-spline curves
  double crease[4];      ///< of the vertex and each neighbour in a new vertex point, and the same in the limit
  int smoothness[4];     ///< at smooth, dart, crease and corner vertices: 0 continuous, 1 with tangent planes
  int square_mean_mode;  ///< see Smoothness
  int has_closed_limits;

  shaolin_mask_of_valence smooth_vertex;  ///< vertex, each neighbour, each new face point (0 on triangles)
  shaolin_mask smooth_edge;               ///< radius 1: each end, each side
  shaolin_mask_of_edge edge_end;          ///< radius 2: Ring(n)

  // Null where the scheme has none.
  shaolin_mask_of_valence dart_vertex;  ///< as smooth_vertex
  shaolin_mask_of_valence cone_vertex;  ///< as smooth_vertex
  shaolin_mask_of_valence face_corner;  ///< radius 2 on quads: Ring(n)

  // With has_closed_limits.
  shaolin_mask_of_valence smooth_limit;      ///< vertex, each neighbour, each diagonal (0 on triangles)
  shaolin_mask_of_direction smooth_tangent;  ///< Ring(n), or nothing where there is no tangent plane
  /// Of a sector of n faces: the vertex, n + 1 spokes, and on quads n diagonals; or nothing.
  shaolin_mask_of_valence crease_cross_tangent;
} shaolin_plugin;

/// The one symbol that a plug-in exports. The struct lives as long as the library is loaded.
const shaolin_plugin* shaolin_scheme_plugin(void);

#ifdef __cplusplus
}
#endif
