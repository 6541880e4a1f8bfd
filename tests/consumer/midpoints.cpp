// A plug-in against the installed headers: the example of docs/schemes.md.
#include <shaolin/schemes/plugin.h>

struct Midpoints {
  static constexpr const char* name = "midpoints";
  static constexpr shaolin::FaceKind face_kind = shaolin::FaceKind::triangle;
  static constexpr shaolin::Smoothness smoothness{0, 0, 0, 0};
  static shaolin::VertexMask smooth_vertex(int) { return {1, 0, 0}; }
  static shaolin::EdgeMask smooth_edge() { return {0.5, 0}; }
};

SHAOLIN_SCHEME_PLUGIN(Midpoints)
