// A plug-in whose every field and answer comes from bytes that the fuzzer gives it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "schemes/plugin_abi.h"

namespace {

const std::uint8_t* bytes = nullptr;
std::size_t left = 0;
char name[80];
shaolin_plugin plugin;

std::uint8_t next() {
  if (left == 0) return 0;
  --left;
  return *bytes++;
}

double number() {
  constexpr double some[]{0.0, 0.5, 0.125, 0.375, 1.0 / 6, -0.0625, 1e300, 1e-320};
  const std::uint8_t kind = next();
  if (kind < 200) return some[kind % 8];
  double any = 0;
  std::uint8_t raw[sizeof any];
  std::generate(raw, raw + sizeof any, next);
  std::memcpy(&any, raw, sizeof any);
  return any;
}

/// As many weights as the bytes say, but no more than there is room: to write beyond would be the plug-in's fault, and
/// what follows the process's.
int answer(shaolin_weights* out) {
  const int kind = next();
  if (kind > 250) {
    const char text[] = "no reason";
    if (kind > 252) std::memcpy(out->error, text, std::min<std::size_t>(sizeof text, out->error_capacity));
    return -1;
  }
  const int count = kind > 240 ? kind - 243 : out->capacity;
  for (int i = 0; i < std::min(count, out->capacity); ++i) out->values[i] = number();
  return count;
}

int of_valence(int, shaolin_weights* out) { return answer(out); }
int of_edge(int, int, shaolin_weights* out) { return answer(out); }
int of_direction(int, double, shaolin_weights* out) { return answer(out); }

template <class Callback>
Callback* maybe(Callback* callback) {
  return next() < 240 ? callback : nullptr;
}

/// Small numbers mostly, any other now and then.
int field(int most) {
  const int value = next();
  return value < 230 ? value % (most + 1) : (value - 243) * 1000000;
}

}  // namespace

extern "C" void fuzz_plugin_with(const std::uint8_t* data, std::size_t size) {
  bytes = data;
  left = size;
  plugin = {};
  plugin.version = next() < 250 ? SHAOLIN_PLUGIN_VERSION : next();
  const std::size_t length = next() < 230 ? next() % 9 : 79;
  std::memset(name, 0, sizeof name);
  std::generate(name, name + length, [] { return static_cast<char>(next() < 230 ? 'a' + next() % 26 : next()); });
  plugin.name = maybe(name);
  plugin.face_kind = 3 + field(1);
  plugin.radius = 1 + field(1);
  plugin.basis = field(2);
  plugin.has_crease = next() % 2;
  std::generate(plugin.crease, plugin.crease + 4, number);
  for (int& smoothness : plugin.smoothness) smoothness = field(1);
  plugin.square_mean_mode = next() % 2;
  plugin.has_closed_limits = next() % 2;
  plugin.smooth_vertex = maybe(of_valence);
  plugin.smooth_edge = maybe(answer);
  plugin.edge_end = maybe(of_edge);
  plugin.dart_vertex = maybe(of_valence);
  plugin.cone_vertex = maybe(of_valence);
  plugin.face_corner = maybe(of_valence);
  plugin.smooth_limit = maybe(of_valence);
  plugin.smooth_tangent = maybe(of_direction);
  plugin.crease_cross_tangent = maybe(of_valence);
}

extern "C" const shaolin_plugin* shaolin_scheme_plugin(void) { return next() < 250 ? &plugin : nullptr; }
