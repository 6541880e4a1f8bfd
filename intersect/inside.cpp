#include "inside.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "../schemes/errors.h"
#include "../schemes/limit_surface.h"

namespace shaolin {

void expect_closed(const LimitSurface& surface) {
  const ControlMesh& mesh = surface.control_mesh();
  for (int f = 0; f < surface.face_count(); ++f)
    if (!surface.has_limit(f)) throw InputError("the surface is open: face " + std::to_string(f) + " is no part of it");
  std::vector<std::pair<int, int>> sides;
  sides.reserve(mesh.face_vertices.size());
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto v = mesh.face(f);
    for (std::size_t i = 0; i < v.size(); ++i)
      if (v[i] != v[(i + 1) % v.size()]) sides.emplace_back(v[i], v[(i + 1) % v.size()]);
  }
  std::sort(sides.begin(), sides.end());
  const auto fail = [](const std::pair<int, int>& side, const char* what) {
    throw InputError("the surface is open at the edge from vertex " + std::to_string(side.first) + " to " +
                     std::to_string(side.second) + ": " + what);
  };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && sides[i] == sides[i - 1]) fail(sides[i], "two faces have it the same way round");
    if (!std::binary_search(sides.begin(), sides.end(), std::pair(sides[i].second, sides[i].first)))
      fail(sides[i], "only one face has it");
  }
}

bool is_inside(const Object& object, const Vec3& point, RayCounters& counters) {
  const Box bounds = object.bounds();
  if ((point.array() < bounds.lower.array()).any() || (point.array() > bounds.upper.array()).any()) return false;
  // Along no axis, diagonal or plane of symmetry that models have.
  static const std::array<Vec3, 8> directions{Vec3(0.523, 0.281, 0.805),   Vec3(-0.337, 0.884, 0.324),
                                              Vec3(0.911, -0.153, -0.383), Vec3(-0.249, -0.617, 0.747),
                                              Vec3(0.173, 0.571, -0.803),  Vec3(-0.859, 0.401, -0.318),
                                              Vec3(0.689, -0.713, 0.127),  Vec3(-0.441, -0.523, -0.729)};
  int winding = 0;
  bool is_certified = false;
  for (const Vec3& direction : directions) {
    winding = 0;
    bool touches = false;
    const Ray ray{point, direction, 0, std::numeric_limits<double>::infinity()};
    const std::vector<Crossing> all = object.all_hits(ray, counters);
    is_certified = count_uncertified(all) == 0;
    for (const Crossing& crossing : all) {
      winding += static_cast<int>(crossing.sense);
      touches |= crossing.sense == Sense::touches;
    }
    if (!touches) break;
  }
  if (!is_certified) ++counters.uncertified;
  return winding != 0;
}

}  // namespace shaolin
