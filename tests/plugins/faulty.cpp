// A plug-in with one fault, named by the environment variable SHAOLIN_TEST_FAULT when it is loaded; without, a sound
// one.
#include <shaolin/schemes/plugin.h>

#include <cstdlib>
#include <limits>
#include <map>
#include <string>

namespace {

std::string fault() {
  const char* const name = std::getenv("SHAOLIN_TEST_FAULT");
  return name ? name : "";
}

/// The triangles themselves, with edge points from the rings of radius 2.
struct Faulty {
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::triangle;

  Faulty() {
    if (fault() == "constructor") throw std::runtime_error("made of glass");
  }

  static shaolin::VertexMask smooth_vertex(int n) {
    if (fault() == "throw" && n == 5) throw std::runtime_error("five is too many");
    if (fault() == "throw int" && n == 5) throw 5;
    if (fault() == "nan" && n == 4) return {1, std::numeric_limits<double>::quiet_NaN(), 0};
    if (fault() == "infinity" && n == 4) return {std::numeric_limits<double>::infinity(), 0, 0};
    if (fault() == "late throw" && n > 8) throw std::runtime_error("more than eight is too many");
    return {1, 0, 0};
  }
  static shaolin::RingMask edge_end(int n, int) {
    const int spokes = fault() == "short ring" && n == 7 ? n - 1 : n;
    return {0.5, std::vector<double>(static_cast<std::size_t>(spokes), 0), {}};
  }
};

int count_without_writing(int, shaolin_weights*) { return 3; }
int two_weights(int, shaolin_weights* out) {
  out->values[0] = 1, out->values[1] = 0;
  return 2;
}
int too_many(int, int, shaolin_weights* out) {
  for (int i = 0; i < out->capacity + 3; ++i) out->values[i] = 0;  // past the capacity, as careless code does
  return out->capacity + 3;
}
int silent_failure(int, shaolin_weights*) { return -1; }
int long_failure(int, shaolin_weights* out) {
  for (int i = 0; i < out->error_capacity; ++i) out->error[i] = 'x';  // no zero byte
  return -1;
}
int let_through(int, shaolin_weights*) { throw std::runtime_error("out it goes"); }

void spoil(const std::string& name, shaolin_plugin& plugin) {
  static const std::map<std::string, void (*)(shaolin_plugin&)> faults = {
      {"version", [](shaolin_plugin& p) { p.version = 99; }},
      {"no name", [](shaolin_plugin& p) { p.name = nullptr; }},
      {"empty name", [](shaolin_plugin& p) { p.name = ""; }},
      {"path as name", [](shaolin_plugin& p) { p.name = "../../etc"; }},
      {"face kind", [](shaolin_plugin& p) { p.face_kind = 5; }},
      {"radius", [](shaolin_plugin& p) { p.radius = 3; }},
      {"basis", [](shaolin_plugin& p) { p.basis = 7; }},
      {"basis of radius 2", [](shaolin_plugin& p) { p.basis = SHAOLIN_BASIS_SPLINE; }},
      {"smoothness", [](shaolin_plugin& p) { p.smoothness[2] = -1; }},
      {"crease", [](shaolin_plugin& p) { p.has_crease = 1, p.crease[1] = std::numeric_limits<double>::infinity(); }},
      {"null vertex", [](shaolin_plugin& p) { p.smooth_vertex = nullptr; }},
      {"null edge", [](shaolin_plugin& p) { p.edge_end = nullptr; }},
      {"null edge of radius 1", [](shaolin_plugin& p) { p.radius = 1; }},
      {"null limits", [](shaolin_plugin& p) { p.has_closed_limits = 1; }},
      {"unwritten", [](shaolin_plugin& p) { p.smooth_vertex = count_without_writing; }},
      {"two weights", [](shaolin_plugin& p) { p.smooth_vertex = two_weights; }},
      {"too many", [](shaolin_plugin& p) { p.edge_end = too_many; }},
      {"silent failure", [](shaolin_plugin& p) { p.smooth_vertex = silent_failure; }},
      {"long failure", [](shaolin_plugin& p) { p.smooth_vertex = long_failure; }},
      {"let through", [](shaolin_plugin& p) { p.smooth_vertex = let_through; }},
  };
  if (const auto at = faults.find(name); at != faults.end()) at->second(plugin);
}

}  // namespace

// What SHAOLIN_SCHEME_PLUGIN(Faulty) would say, with the fault.
extern "C" __attribute__((visibility("default"))) const shaolin_plugin* shaolin_scheme_plugin(void) {
  static shaolin_plugin plugin;
  if (fault() == "entry throws") throw std::runtime_error("no entry");
  if (fault() == "entry is null") return nullptr;
  plugin = shaolin::make_plugin<Faulty>("Faulty");
  spoil(fault(), plugin);
  return &plugin;
}
