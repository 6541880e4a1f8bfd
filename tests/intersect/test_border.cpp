// Hulls of border curves, and hulls in a plane.
#include "intersect/border.h"
#include "intersect/plane_hull.h"
#include "schemes/builtin.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/meshes.h"
#include "tests/property.h"

namespace shaolin {

namespace {

/// By all lines through two points: one with all points strictly on its other side from the origin parts them.
bool origin_in_hull_slowly(const std::vector<Eigen::Vector2d>& points) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  // The origin is outside if some direction has all points in an open half plane: try the bisectors of all pairs.
  for (const auto& a : points)
    for (const auto& b : points) {
      if (a.isZero(0) || b.isZero(0)) return true;
      const Eigen::Vector2d middle = a.normalized() + b.normalized();
      const bool all = std::all_of(points.begin(), points.end(), [&](const auto& p) { return middle.dot(p) > 0; });
      if (all && (cross(a, b) != 0 || a.dot(b) > 0)) return false;
    }
  return true;
}

/// Calls visit(patch, edge, surface, at(t)) for every edge of every face.
template <class Visit>
void for_each_edge(const std::string& scheme, const ControlMesh& mesh, Visit visit) {
  with_scheme(scheme, [&](const auto& type) {
    using S = std::decay_t<decltype(type)>;
    using D = Domain<S::face_kind>;
    const SchemeSurface<S> surface(mesh, type);
    for (int face = 0; face < surface.face_count(); ++face) {
      if (!surface.has_limit(face)) continue;
      for (int sub = 0; sub < surface.sub_count(face); ++sub)
        for (int edge = 0; edge < D::corner_count; ++edge) {
          const auto& a = D::corners[static_cast<std::size_t>(edge)];
          const auto& b = D::corners[static_cast<std::size_t>((edge + 1) % D::corner_count)];
          visit(surface.patch(face, sub), edge, [&](double t) {
            const Parameter at = D::nearest({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
            return surface.evaluate({face, sub, at.x(), at.y()})->position;
          });
        }
    }
  });
}

std::vector<std::pair<std::string, ControlMesh>> meshes() {
  ControlMesh creased = with_edges(shaken(torus("catmark", 4, 6), 0.1), {{0, 1, 2.5f}, {1, 2, 10}, {2, 3, 0.5f}});
  return {{"catmark", shaken(poles("catmark", 5), 0.1)}, {"loop", shaken(poles("loop", 7), 0.1)},
          {"loop", shaken(poles("loop", 3), 0.2)},       {"catmark", shaken(prism(5), 0.1)},
          {"loop", shaken(sheet("loop", 4, 3), 0.1)},    {"catmark", std::move(creased)}};
}

}  // namespace

TEST_CASE("The origin is in the hull of points as all half planes say", "[intersect][border]") {
  check_property([](std::vector<std::pair<int, int>> coordinates) {
    RC_PRE(!coordinates.empty());
    OriginInHull hull;
    std::vector<Eigen::Vector2d> points;
    for (const auto& [x, y] : coordinates) {
      points.emplace_back(x % 8, y % 8);
      hull.add(x % 8, y % 8);
    }
    RC_ASSERT(hull.holds() == origin_in_hull_slowly(points));
  });
  OriginInHull near(1e-3), far(1e-5);
  for (const double x : {-1.0, 1.0}) {
    near.add(x, 1e-4);
    far.add(x, 1e-4);
  }
  CHECK(near.holds());
  CHECK(!far.holds());
}

TEST_CASE("Bounds of border curves hold the curves", "[intersect][border]") {
  for (const auto& [scheme, mesh] : meshes()) {
    CAPTURE(scheme);
    for_each_edge(scheme, mesh, [](const auto& patch, int edge, const auto& at) {
      std::vector<Vec3> points;
      add_border_bound(patch, edge, 5, 10, points);
      REQUIRE(points.size() >= 4);
      // Seen along some directions, each sample must be in the plane hull.
      for (const Vec3& view : {Vec3(0.36, 0.48, 0.8), Vec3(-0.8, 0.6, 0), Vec3(0, 0, 1)}) {
        const Vec3 x = view.unitOrthogonal(), y = view.cross(x);
        for (int i = 0; i <= 20; ++i) {
          const Vec3 sample = at(i / 20.0);
          OriginInHull hull(1e-12);
          for (const Vec3& point : points) hull.add(x.dot(point - sample), y.dot(point - sample));
          REQUIRE(hull.holds());
        }
      }
    });
  }
}

TEST_CASE("The paper's stand-in is the border curve where that is regular, and leaves it elsewhere",
          "[intersect][border]") {
  double irregular = 0;
  int regular_edges = 0;
  for (const auto& [scheme, mesh] : meshes())
    for_each_edge(scheme, mesh, [&](const auto& patch, int edge, const auto& at) {
      std::vector<Vec3> c;
      if (!add_stand_in(patch, edge, c)) return;
      REQUIRE(c.size() == 5);
      regular_edges += patch.is_regular();
      for (int i = 0; i <= 8; ++i) {
        const double t = i / 8.0, s = 1 - t;
        const Vec3 point = s * s * s * s * c[0] + 4 * s * s * s * t * c[1] + 6 * s * s * t * t * c[2] +
                           4 * s * t * t * t * c[3] + t * t * t * t * c[4];
        const double distance = (point - at(t)).norm();
        if (patch.is_regular()) {
          REQUIRE(distance < 1e-13);
        } else {
          irregular = std::max(irregular, distance);
          if (i % 4 == 0) REQUIRE(distance < 1e-12);  // at its ends and its middle it is on the curve
        }
      }
    });
  CHECK(regular_edges > 10);
  CHECK(irregular > 1e-4);
}

}  // namespace shaolin
