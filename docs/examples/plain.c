/* Loop's scheme as a plug-in in plain C: the struct is written by hand, and the host derives limit masks. */
#include <math.h>
#include <shaolin/schemes/plugin_abi.h>

static int give(shaolin_weights* out, const double* weights, int count) {
  for (int i = 0; i < count && i < out->capacity; ++i) out->values[i] = weights[i];
  return count;
}

static int smooth_vertex(int n, shaolin_weights* out) {
  const double centre = 3.0 / 8 + cos(2 * acos(-1) / n) / 4;
  const double neighbour = (5.0 / 8 - centre * centre) / n;
  const double weights[] = {1 - n * neighbour, neighbour, 0};
  return give(out, weights, 3);
}

static int smooth_edge(shaolin_weights* out) {
  const double weights[] = {3.0 / 8, 1.0 / 8};
  return give(out, weights, 2);
}

const shaolin_plugin* shaolin_scheme_plugin(void) {
  static const shaolin_plugin plugin = {
      .version = SHAOLIN_PLUGIN_VERSION,
      .name = "plain",
      .face_kind = 3,
      .radius = 1,
      .basis = SHAOLIN_BASIS_SPLINE,
      .smoothness = {1, 1, 1, 0},
      .square_mean_mode = 1,
      .smooth_vertex = smooth_vertex,
      .smooth_edge = smooth_edge,
  };
  return &plugin;
}
