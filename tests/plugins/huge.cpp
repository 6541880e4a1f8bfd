// A plug-in of the named polynomials whose vertex masks are out of all proportion; SHAOLIN_TEST_FAULT says how: "V A"
// are the weights of the vertex and of all its neighbours together, "V A F" the edge mask's weight beside the edge,
// too.
#include <shaolin/schemes/plugin.h>

#include <cstdlib>
#include <sstream>

namespace {

struct Weights {
  double vertex = 0.5, around = 0.5, side = 0.125;

  Weights() {
    const char* const text = std::getenv("SHAOLIN_TEST_FAULT");
    std::istringstream(text ? text : "") >> vertex >> around >> side;
  }
};

struct Huge {
  static constexpr const char* name = "huge";
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::triangle;
  static constexpr shaolin::Basis basis = shaolin::Basis::spline;
  static shaolin::VertexMask smooth_vertex(int n) { return {Weights().vertex, Weights().around / n, 0}; }
  static shaolin::EdgeMask smooth_edge() { return {0.375, Weights().side}; }
};

}  // namespace

SHAOLIN_SCHEME_PLUGIN(Huge)
