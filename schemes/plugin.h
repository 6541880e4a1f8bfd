#pragma once
/// For authors of plug-ins: a scheme and one macro make a shared library that every tool loads by --plugin. Needs no
/// part of the library but headers.
#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include "plugin_abi.h"
#include "scheme.h"

/// Exports the scheme; stands once in a library, outside of any namespace. The scheme's name is its member `name`, or
/// else the type as it is written here. Exceptions of the scheme's masks reach the host as text.
#define SHAOLIN_SCHEME_PLUGIN(Type)                                                                     \
  extern "C" __attribute__((visibility("default"))) const shaolin_plugin* shaolin_scheme_plugin(void) { \
    static const shaolin_plugin plugin = shaolin::make_plugin<Type>(#Type);                             \
    return &plugin;                                                                                     \
  }

namespace shaolin {

/// The C callbacks of a scheme.
template <Scheme S>
struct PluginCallbacks {
  static int smooth_vertex(int n, shaolin_weights* out) {
    return answer(out, [&] { return flat(scheme().smooth_vertex(n)); });
  }
  static int dart_vertex(int n, shaolin_weights* out) {
    return answer(out, [&] { return flat(dart_vertex_of(scheme(), n)); });
  }
  static int cone_vertex(int n, shaolin_weights* out) {
    return answer(out, [&] { return flat(cone_vertex_of(scheme(), n)); });
  }
  static int smooth_edge(shaolin_weights* out) {
    return answer(out, [&] {
      const EdgeMask mask = scheme().smooth_edge();
      return std::vector<double>{mask.end, mask.side};
    });
  }
  static int edge_end(int n, int other, shaolin_weights* out) {
    return answer(out, [&] { return flat(scheme().edge_end(n, other), n, n); });
  }
  static int face_corner(int n, shaolin_weights* out) {
    return answer(out, [&] { return flat(face_corner_of(scheme(), n), n, n); });
  }
  static int smooth_limit(int n, shaolin_weights* out) {
    return answer(out, [&] {
      const LimitMask mask = scheme().smooth_limit(n);
      return std::vector<double>{mask.vertex, mask.edge, mask.diagonal};
    });
  }
  static int smooth_tangent(int n, double first, shaolin_weights* out) {
    return answer(out, [&] { return flat(scheme().smooth_tangent(n, first), n, n); });
  }
  static int crease_cross_tangent(int k, shaolin_weights* out) {
    return answer(out, [&] { return flat(scheme().crease_cross_tangent(k), k + 1, k); });
  }

  /// Made anew for every call: masks are asked for once per configuration, and a library that stays loaded keeps
  /// nothing.
  static S scheme() { return S{}; }

 private:
  static std::vector<double> flat(const VertexMask& mask) { return {mask.vertex, mask.edge, mask.face}; }

  /// Vertex, edges, diagonals. Nothing for a mask without weights; no diagonals on quads stand for zeros. Throws
  /// std::length_error for any other number: a sum of lengths alone could hide an error.
  static std::vector<double> flat(const RingMask& mask, int spokes, int faces) {
    if (mask.edges.empty() && mask.diagonals.empty()) return {};
    const auto edge_count = static_cast<std::size_t>(spokes);
    const auto face_count = static_cast<std::size_t>(S::face_kind == FaceKind::quad ? faces : 0);
    if (mask.edges.size() != edge_count || (!mask.diagonals.empty() && mask.diagonals.size() != face_count))
      throw std::length_error("it has " + counts(mask.edges.size(), mask.diagonals.size()) + ", expected " +
                              counts(edge_count, face_count));
    std::vector<double> weights{mask.vertex};
    weights.insert(weights.end(), mask.edges.begin(), mask.edges.end());
    weights.insert(weights.end(), mask.diagonals.begin(), mask.diagonals.end());
    weights.resize(1 + edge_count + face_count, 0);
    return weights;
  }
  static std::string counts(std::size_t edges, std::size_t diagonals) {
    return std::to_string(edges) + " edge weights and " + std::to_string(diagonals) + " diagonal weights";
  }

  template <class Mask>
  static int answer(shaolin_weights* out, Mask mask) noexcept {
    try {
      const std::vector<double> weights = mask();
      const int count = static_cast<int>(weights.size());
      std::copy_n(weights.begin(), std::min(count, out->capacity), out->values);
      return count;
    } catch (const std::exception& error) {
      return fail(out, error.what());
    } catch (...) {
      return fail(out, "it threw something that is no std::exception");
    }
  }
  static int fail(shaolin_weights* out, const char* text) noexcept {
    if (out->error_capacity > 0) {
      std::strncpy(out->error, text, static_cast<std::size_t>(out->error_capacity) - 1);
      out->error[out->error_capacity - 1] = '\0';
    }
    return -1;
  }
};

/// The C struct of a scheme; `type` is its name if it has no member of that name. Where the scheme cannot even be made
/// its constants stay the defaults, and the first mask that the host asks for says why.
template <Scheme S>
shaolin_plugin make_plugin(const char* type) noexcept {
  using Callbacks = PluginCallbacks<S>;
  shaolin_plugin plugin{};
  plugin.version = SHAOLIN_PLUGIN_VERSION;
  plugin.name = type;
  if constexpr (requires { std::string(S::name); }) plugin.name = S::name;
  plugin.face_kind = S::face_kind == FaceKind::triangle ? 3 : 4;
  plugin.radius = RingMasks<S> ? 2 : 1;
  plugin.smooth_vertex = Callbacks::smooth_vertex;
  if constexpr (EdgeMasks<S>) plugin.smooth_edge = Callbacks::smooth_edge;
  if constexpr (RingMasks<S>) plugin.edge_end = Callbacks::edge_end;
  if constexpr (requires(const S scheme) { scheme.dart_vertex(3); }) plugin.dart_vertex = Callbacks::dart_vertex;
  if constexpr (requires(const S scheme) { scheme.cone_vertex(3); }) plugin.cone_vertex = Callbacks::cone_vertex;
  if constexpr (requires(const S scheme) { scheme.face_corner(3); }) plugin.face_corner = Callbacks::face_corner;
  if constexpr (ClosedLimits<S>) {
    plugin.smooth_limit = Callbacks::smooth_limit;
    plugin.smooth_tangent = Callbacks::smooth_tangent;
    plugin.crease_cross_tangent = Callbacks::crease_cross_tangent;
  }
  try {
    const S scheme = Callbacks::scheme();
    plugin.radius = radius_of(scheme);
    plugin.basis = static_cast<int>(basis_of(scheme));
    if constexpr (requires { scheme.crease; }) {
      const CreaseMask crease = scheme.crease;
      plugin.has_crease = 1;
      plugin.crease[0] = crease.vertex;
      plugin.crease[1] = crease.edge;
      plugin.crease[2] = crease.limit_vertex;
      plugin.crease[3] = crease.limit_edge;
    }
    const Smoothness smoothness = smoothness_of(scheme);
    plugin.smoothness[0] = smoothness.smooth;
    plugin.smoothness[1] = smoothness.dart;
    plugin.smoothness[2] = smoothness.crease;
    plugin.smoothness[3] = smoothness.corner;
    plugin.square_mean_mode = smoothness.square_mean_mode;
    plugin.has_closed_limits = has_closed_limits(scheme);
  } catch (...) {  // see above
  }
  return plugin;
}

static_assert(static_cast<int>(Basis::none) == SHAOLIN_BASIS_NONE &&
              static_cast<int>(Basis::spline) == SHAOLIN_BASIS_SPLINE &&
              static_cast<int>(Basis::linear) == SHAOLIN_BASIS_LINEAR);

}  // namespace shaolin
