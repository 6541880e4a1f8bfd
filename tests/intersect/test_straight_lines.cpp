// Rays that run within the surface, to rounding, for a while: the closest hit is where all hits begin.
#include <random>

#include "intersect/scene.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// Along u or v through a place of a face, half of them on two of its sides.
class TangentRays {
 public:
  explicit TangentRays(const LimitSurface& surface) : surface_(surface), diagonal_(surface.control_mesh().diagonal()) {}

  std::optional<Ray> next() {
    const int face = index(surface_.face_count());
    const int sub = index(surface_.sub_count(face));
    double u = share();
    double v = share();
    const int side = index(4);
    if (side == 0) u = 0;
    if (side == 1) v = 0;
    if (surface_.triangular() && u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const std::optional<LimitSample> at = surface_.evaluate({face, sub, u, v});
    if (!at || !at->derivatives) return {};
    const Vec3 way = random_() & 1U ? at->derivatives->du : at->derivatives->dv;
    if (!(way.norm() > 0)) return {};
    return Ray{at->position - 3 * diagonal_ * way.normalized(), way.normalized()};
  }

 private:
  int index(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }
  double share() { return static_cast<double>(random_() >> 11U) * 0x1p-53; }

  const LimitSurface& surface_;
  double diagonal_;
  std::mt19937_64 random_{3};  // with which rook, cube_creases and catmark_dart_edgecorner were behind, by up to 0.03
};

}  // namespace

TEST_CASE("A ray along a straight line of the surface is met where all its hits begin", "[intersect][all_hits][sweep]") {
  int rays = 0;
  for (const Model& model : all_models()) {
    if (model.name != "rook" && model.name != "cube_creases" && model.name != "catmark_dart_edgecorner") continue;
    const Scene scene(model.mesh, model.scheme);
    const double diagonal = model.mesh.diagonal();
    TangentRays tangents(scene.surface());
    for (int i = 0; i < 400; ++i) {
      const std::optional<Ray> ray = tangents.next();
      if (!ray) continue;
      INFO(model.name << " " << i);
      const std::uint64_t cells = scene.statistics().cells;
      const std::optional<Hit> hit = scene.intersect(*ray);
      CHECK(scene.statistics().cells - cells < 2000);  // 424 at most
      const std::vector<Crossing> all = scene.all_hits(*ray);
      REQUIRE(hit.has_value() == !all.empty());
      if (!hit) continue;
      ++rays;
      CHECK(hit->t <= all.front().hit.t + 1e-7 * diagonal);
    }
  }
  CHECK(rays > 500);
}

}  // namespace shaolin
