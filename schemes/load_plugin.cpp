#include "load_plugin.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "errors.h"
#include "plugin_abi.h"
#include "text.h"

namespace shaolin {
namespace {

constexpr int first_tried_valence = 3, last_tried_valence = 8;

using Library = std::shared_ptr<void>;

/// The loader's last complaint.
std::string loader_error() {
  const char* const text = dlerror();
  return text ? text : "no reason given";
}

Library open_library(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) throw InputError("no such file", file.string());
  if (std::filesystem::is_directory(file, ignored))
    throw InputError("is a directory, expected a shared library", file.string());
  // Absolute, for the loader would look for a bare name in the system's folders.
  void* const handle = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw InputError("cannot be loaded, expected a shared library (" + loader_error() + ")", file.string());
  return {handle, [](void* library) { dlclose(library); }};
}

/// Calls code of the library; an exception that it lets out becomes an InputError "WHAT failed: ...".
template <class Call>
auto guarded(const std::string& what, const std::string& file, Call call) {
  std::string reason;
  try {
    return call();
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
    reason = "it threw something that is no std::exception";
  }
  throw InputError(what + " failed: " + reason, file);
}

const shaolin_plugin& entry_of(const Library& library, const std::string& file) {
  dlerror();
  void* const symbol = dlsym(library.get(), "shaolin_scheme_plugin");
  if (!symbol)
    throw InputError("is no plug-in: it does not export shaolin_scheme_plugin(); see SHAOLIN_SCHEME_PLUGIN", file);
  const auto entry = reinterpret_cast<const shaolin_plugin* (*)()>(symbol);
  const shaolin_plugin* const plugin = guarded("shaolin_scheme_plugin()", file, entry);
  if (!plugin) throw InputError("shaolin_scheme_plugin() returned null, expected a plug-in", file);
  if (plugin->version != SHAOLIN_PLUGIN_VERSION)
    throw InputError("is a plug-in of version " + std::to_string(plugin->version) + ", expected version " +
                         std::to_string(SHAOLIN_PLUGIN_VERSION) + "; compile it against this shaolin's headers",
                     file);
  return *plugin;
}

/// Holds the constants of a plug-in against what they may be.
class FieldCheck {
 public:
  FieldCheck(const shaolin_plugin& plugin, std::string file) : plugin_(plugin), file_(std::move(file)) {}

  void run() const {
    require(is_name(plugin_.name), "its name is " + (plugin_.name ? quoted(plugin_.name) : "null") +
                                       ", expected 1 to 64 letters, digits and characters of \"_-+.: \"");
    one_of("face_kind", plugin_.face_kind, 3, 4);
    one_of("radius", plugin_.radius, 1, 2);
    one_of("basis", plugin_.basis, SHAOLIN_BASIS_NONE, SHAOLIN_BASIS_LINEAR);
    require(plugin_.basis == SHAOLIN_BASIS_NONE || plugin_.radius == 1,
            "its radius is 2 and its basis " + std::to_string(plugin_.basis) + ", expected basis 0: no polynomials");
    for (const int smoothness : plugin_.smoothness) one_of("smoothness", smoothness, 0, 1);
    if (plugin_.has_crease)
      for (const double weight : plugin_.crease)
        require(std::isfinite(weight), "a crease weight is " + std::to_string(weight) + ", expected a finite number");
    callback("smooth_vertex", plugin_.smooth_vertex, "every scheme");
    if (plugin_.radius == 1) callback("smooth_edge", plugin_.smooth_edge, "radius 1");
    if (plugin_.radius == 2) callback("edge_end", plugin_.edge_end, "radius 2");
    if (!plugin_.has_closed_limits) return;
    callback("smooth_limit", plugin_.smooth_limit, "closed limits");
    callback("smooth_tangent", plugin_.smooth_tangent, "closed limits");
    callback("crease_cross_tangent", plugin_.crease_cross_tangent, "closed limits");
  }

 private:
  /// Names become parts of messages, reports and file names.
  static bool is_name(const char* name) {
    if (!name) return false;
    const std::string_view text(name, strnlen(name, 65));
    return !text.empty() && text.size() <= 64 && text.front() != '.' &&
           std::all_of(text.begin(), text.end(), [](char c) {
             return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || strchr("_-+.: ", c);
           });
  }
  void require(bool holds, const std::string& message) const {
    if (!holds) throw InputError("cannot be used: " + message, file_);
  }
  void one_of(const std::string& field, int value, int least, int most) const {
    require(least <= value && value <= most, "its " + field + " is " + std::to_string(value) + ", expected " +
                                                 std::to_string(least) + " to " + std::to_string(most));
  }
  template <class Callback>
  void callback(const std::string& name, Callback pointer, const std::string& why) const {
    require(pointer != nullptr, "its callback " + name + " is null, expected one, for it is needed by " + why);
  }

  const shaolin_plugin& plugin_;
  std::string file_;
};

/// The masks of a plug-in whose fields have been checked.
class PluginMasks final : public SchemeMasks {
 public:
  PluginMasks(Library library, const shaolin_plugin& plugin, std::string file)
      : library_(std::move(library)), plugin_(plugin), file_(std::move(file)) {}

  FaceKind face_kind() const override { return quads() ? FaceKind::quad : FaceKind::triangle; }
  int radius() const override { return plugin_.radius; }
  Basis basis() const override { return static_cast<Basis>(plugin_.basis); }
  CreaseMask crease() const override {
    const auto& weights = plugin_.crease;
    return plugin_.has_crease ? CreaseMask{weights[0], weights[1], weights[2], weights[3]} : cubic_crease;
  }
  Smoothness smoothness() const override {
    const auto& at = plugin_.smoothness;
    return {at[0], at[1], at[2], at[3], plugin_.square_mean_mode != 0};
  }
  VertexMask smooth_vertex(int n) const override { return vertex_mask("smooth_vertex", plugin_.smooth_vertex, n); }
  VertexMask dart_vertex(int n) const override {
    return plugin_.dart_vertex ? vertex_mask("dart_vertex", plugin_.dart_vertex, n) : smooth_vertex(n);
  }
  VertexMask cone_vertex(int n) const override {
    return plugin_.cone_vertex ? vertex_mask("cone_vertex", plugin_.cone_vertex, n) : smooth_vertex(n);
  }
  EdgeMask smooth_edge() const override {
    const auto weights = ask("smooth_edge()", 2, false, plugin_.smooth_edge);
    return {weights[0], weights[1]};
  }
  RingMask edge_end(int n, int other) const override {
    return ring("edge_end" + arguments(n, other), n, n, false,
                [&](shaolin_weights* out) { return plugin_.edge_end(n, other, out); });
  }
  RingMask face_corner(int n) const override {
    if (!plugin_.face_corner) return quarter_of_corner(n);
    return ring("face_corner" + arguments(n), n, n, false,
                [&](shaolin_weights* out) { return plugin_.face_corner(n, out); });
  }
  bool has_closed_limits() const override { return plugin_.has_closed_limits != 0; }
  LimitMask smooth_limit(int n) const override {
    const VertexMask mask = vertex_mask("smooth_limit", plugin_.smooth_limit, n);
    return {mask.vertex, mask.edge, mask.face};
  }
  RingMask smooth_tangent(int n, double first) const override {
    return ring("smooth_tangent" + arguments(n, first), n, n, true,
                [&](shaolin_weights* out) { return plugin_.smooth_tangent(n, first, out); });
  }
  RingMask crease_cross_tangent(int k) const override {
    return ring("crease_cross_tangent" + arguments(k), k + 1, k, true,
                [&](shaolin_weights* out) { return plugin_.crease_cross_tangent(k, out); });
  }

  /// Asks for every mask at a few valences.
  void try_all() const {
    if (radius() == 1) smooth_edge();
    for (int n = first_tried_valence; n <= last_tried_valence; ++n) {
      smooth_vertex(n), dart_vertex(n), cone_vertex(n);
      if (radius() == 2) {
        face_corner(n);
        for (int other = first_tried_valence; other <= last_tried_valence; ++other) edge_end(n, other);
      }
      if (has_closed_limits()) smooth_limit(n), smooth_tangent(n, 0), crease_cross_tangent(n - 2);
    }
  }

 private:
  bool quads() const { return plugin_.face_kind == 4; }

  static std::string arguments(int n) { return "(" + std::to_string(n) + ")"; }
  template <class Second>
  static std::string arguments(int n, Second second) {
    return "(" + std::to_string(n) + ", " + std::to_string(second) + ")";
  }

  VertexMask vertex_mask(const char* name, shaolin_mask_of_valence callback, int n) const {
    const auto weights = ask(name + arguments(n), 3, false, [&](shaolin_weights* out) { return callback(n, out); });
    return {weights[0], weights[1], weights[2]};
  }

  template <class Call>
  RingMask ring(const std::string& mask, int spokes, int faces, bool may_be_empty, Call call) const {
    const int diagonals = quads() ? faces : 0;
    const auto weights = ask(mask, 1 + spokes + diagonals, may_be_empty, call);
    if (weights.empty()) return {};
    const auto first_diagonal = weights.begin() + 1 + spokes;
    return {weights[0], {weights.begin() + 1, first_diagonal}, {first_diagonal, weights.end()}};
  }

  /// The weights of one mask. `call(shaolin_weights*)` calls the plug-in.
  template <class Call>
  std::vector<double> ask(const std::string& mask, int expected, bool may_be_empty, Call call) const {
    // What a callback claims to have written and has not shows as NaN. The slack bears callbacks in C that are off by
    // some weights and do not look at the capacity.
    constexpr int slack = 16;
    std::vector<double> weights(static_cast<std::size_t>(expected + slack), std::numeric_limits<double>::quiet_NaN());
    std::array<char, 512> error{};
    shaolin_weights out{weights.data(), expected, error.data(), static_cast<int>(error.size())};
    const std::string what = mask + " of the scheme " + quoted(plugin_.name);
    const int count = guarded(what, file_, [&] { return call(&out); });
    if (count < 0) {
      error.back() = '\0';
      throw InputError(what + " failed: " + (error[0] ? error.data() : "no reason given"), file_);
    }
    if (count == 0 && may_be_empty) return {};
    if (count != expected)
      throw InputError(what + " gave " + std::to_string(count) + " weights, expected " + std::to_string(expected),
                       file_);
    weights.resize(static_cast<std::size_t>(expected));
    for (std::size_t i = 0; i < weights.size(); ++i)
      if (!std::isfinite(weights[i]))
        throw InputError(what + " gave " + std::to_string(weights[i]) + " as weight " + std::to_string(i + 1) + " of " +
                             std::to_string(expected) + ", expected a finite number",
                         file_);
    return weights;
  }

  Library library_;  // first: all else points into it
  const shaolin_plugin& plugin_;
  std::string file_;
};

}  // namespace

LoadedPlugin load_plugin(const std::filesystem::path& file) {
  const Library library = open_library(file);
  const shaolin_plugin& plugin = entry_of(library, file.string());
  FieldCheck(plugin, file.string()).run();
  const auto masks = std::make_shared<PluginMasks>(library, plugin, file.string());
  masks->try_all();
  return {plugin.name, masks, plugin.has_crease != 0};
}

}  // namespace shaolin
