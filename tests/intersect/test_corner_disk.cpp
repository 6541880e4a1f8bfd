// Which way a ray passes a vertex, by the rim of a disk around it.
#include "intersect/corner_disk.h"
#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/meshes.h"

namespace shaolin {

namespace {

/// The corners of all faces at the cube's vertex at a point.
std::vector<SurfaceParameter> corners_at(const LimitSurface& surface, const Vec3& point) {
  std::vector<SurfaceParameter> corners;
  for (int f = 0; f < surface.face_count(); ++f)
    for (const double u : {0.0, 1.0})
      for (const double v : {0.0, 1.0})
        if ((surface.evaluate({f, 0, u, v})->position - point).norm() < 1e-12) corners.push_back({f, 0, u, v});
  return corners;
}

}  // namespace

TEST_CASE("A disk around a corner says how a ray passes it", "[intersect][corner_disk]") {
  const std::unique_ptr<LimitSurface> surface = make_limit_surface(cube(), "bilinear");
  const Vec3 corner = surface->evaluate({0, 0, 0, 0})->position;
  const Vec3 inward = (-corner).normalized();
  const std::vector<SurfaceParameter> corners = corners_at(*surface, corner);
  REQUIRE(corners.size() == 3);
  const auto turns = [&](const Vec3& through, const Vec3& direction, double clearance) {
    std::optional<CornerDisk> disk = CornerDisk::around(corners, false);
    REQUIRE(disk);
    return disk->grow_and_wind(*surface, through, direction, clearance);
  };
  CHECK(turns(corner, inward, 1e-9) == -1);
  CHECK(turns(corner, -inward, 1e-9) == 1);
  // As far off as it is known, it passes on the same side, and a larger disk says so.
  CHECK(turns(corner + Vec3(1e-4, -1e-4, 0), inward, 1e-2) == -1);
  // A ray that touches the corner from outside.
  const Vec3 beside = inward.unitOrthogonal();
  CHECK(turns(corner, beside, 1e-9) == 0);
  // No rim of these faces is that far away.
  CHECK_FALSE(turns(corner, inward, 10));
}

TEST_CASE("The rim of a disk that misses a face is not closed", "[intersect][corner_disk]") {
  const std::unique_ptr<LimitSurface> surface = make_limit_surface(cube(), "catmark");
  const Vec3 corner = surface->evaluate({0, 0, 0, 0})->position;
  std::vector<SurfaceParameter> corners = corners_at(*surface, corner);
  std::optional<CornerDisk> whole = CornerDisk::around(corners, false);
  REQUIRE(whole);
  CHECK(whole->grow_and_wind(*surface, corner, -corner.normalized(), 1e-9) == -1);
  corners.pop_back();
  std::optional<CornerDisk> part = CornerDisk::around(corners, false);
  REQUIRE(part);
  CHECK_FALSE(part->grow_and_wind(*surface, corner, -corner.normalized(), 1e-9));
}

TEST_CASE("A disk holds its places, twice over", "[intersect][corner_disk]") {
  const std::vector<SurfaceParameter> places{{3, 0, 0.01, 0.02}, {3, 0, 0.05, 0.001}, {7, 1, 0.99, 0.9}};
  const std::optional<CornerDisk> disk = CornerDisk::around(places, false);
  REQUIRE(disk);
  for (const SurfaceParameter& at : places) CHECK(disk->contains(at));
  CHECK(disk->contains({7, 1, 0.81, 0.99}));
  CHECK_FALSE(disk->contains({7, 1, 0.79, 0.99}));
  CHECK_FALSE(disk->contains({7, 0, 1, 1}));
  CHECK_FALSE(disk->contains({3, 0, 0.5, 0.5}));
  // Of a triangle the third corner is where neither u nor v is large.
  const std::optional<CornerDisk> triangle = CornerDisk::around(std::vector<SurfaceParameter>{{0, 0, 0.1, 0.8}}, true);
  REQUIRE(triangle);
  CHECK(triangle->contains({0, 0, 0, 1}));
  CHECK_FALSE(CornerDisk::around(std::vector<SurfaceParameter>{{0, 0, 0.4, 0.1}}, false));
}

}  // namespace shaolin
