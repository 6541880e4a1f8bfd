// Whether projected nets are planar, against exact integers; and whether patches that are called valid are.
#include "intersect/overlap.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "intersect/valid_parts.h"
#include "schemes/catmull_clark.h"
#include "schemes/linear.h"
#include "schemes/loop.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/meshes.h"
#include "tests/property.h"

namespace shaolin {

namespace {

using Edge = std::array<int, 2>;
using IntegerPoint = std::array<std::int64_t, 3>;

std::int64_t sign(std::int64_t x) { return (x > 0) - (x < 0); }

/// The slow twin: points of small integers, seen along an integer normal, in integer coordinates of the plane.
class IntegerNet {
 public:
  IntegerNet(const std::vector<IntegerPoint>& points, const IntegerPoint& n) {
    const IntegerPoint u = n[0] == 0 && n[1] == 0 ? IntegerPoint{1, 0, 0} : IntegerPoint{-n[1], n[0], 0};
    const IntegerPoint v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
    const auto dot = [](const IntegerPoint& a, const IntegerPoint& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    for (const IntegerPoint& p : points) flat_.push_back({dot(u, p), dot(v, p)});
  }

  bool is_planar(const std::vector<Edge>& edges) const {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (at(edges[i][0]) == at(edges[i][1])) return false;
      for (std::size_t j = 0; j < i; ++j)
        if (!is_fine(edges[i], edges[j])) return false;
    }
    return true;
  }

 private:
  using Flat = std::array<std::int64_t, 2>;
  const Flat& at(int i) const { return flat_[static_cast<std::size_t>(i)]; }

  std::int64_t side(const Flat& a, const Flat& b, const Flat& c) const {
    return sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }
  /// c, which is on the line, lies in the segment.
  bool holds(const Flat& a, const Flat& b, const Flat& c) const {
    return side(a, b, c) == 0 && (c[0] - a[0]) * (c[0] - b[0]) <= 0 && (c[1] - a[1]) * (c[1] - b[1]) <= 0;
  }
  /// The segments share no point but common ends.
  bool is_fine(const Edge& e, const Edge& f) const {
    const Flat &a = at(e[0]), &b = at(e[1]), &c = at(f[0]), &d = at(f[1]);
    const auto common = [](int i, const Edge& g) { return i == g[0] || i == g[1]; };
    if (common(e[0], f) && common(e[1], f)) return false;
    if (!common(f[0], e) && holds(a, b, c)) return false;
    if (!common(f[1], e) && holds(a, b, d)) return false;
    if (!common(e[0], f) && holds(c, d, a)) return false;
    if (!common(e[1], f) && holds(c, d, b)) return false;
    return side(a, b, c) * side(a, b, d) >= 0 || side(c, d, a) * side(c, d, b) >= 0;
  }

  std::vector<Flat> flat_;
};

Vec3 to_vec(const IntegerPoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace

TEST_CASE("Planarity is decided as integers decide it", "[intersect][overlap]") {
  Random random(11);
  int planar = 0, touching = 0;
  for (int round = 0; round < 20000; ++round) {
    const int extent = 2 + random.index(4), count = 3 + random.index(3);
    const auto small = [&] { return static_cast<std::int64_t>(random.index(2 * extent + 1) - extent); };
    const auto point = [&] {
      const std::int64_t x = small(), y = small();
      return IntegerPoint{x, y, small()};
    };
    std::vector<IntegerPoint> points;
    for (int i = 0; i < count; ++i) points.push_back(point());
    IntegerPoint n = point();
    if (n == IntegerPoint{}) n[2] = 1;
    std::vector<Edge> edges;
    for (int i = 0; i < count; ++i) {
      const int a = random.index(count), b = (a + 1 + random.index(count - 1)) % count;
      edges.push_back({a, b});
    }
    const bool expected = IntegerNet(points, n).is_planar(edges);
    // Also far from the origin and small: integers that doubles hold, so that nothing changes.
    for (const auto& [scale, offset] :
         {std::pair(1.0, 0.0), std::pair(0x1p-20, 3.0), std::pair(0x1p-400, 0.0), std::pair(0x1p400, 0.0)}) {
      std::vector<Vec3> exact;
      for (const IntegerPoint& p : points) exact.push_back(scale * to_vec(p) + Vec3::Constant(offset));
      INFO("round " << round << " scale " << scale);
      REQUIRE(is_planar_straight_line_graph(exact, edges, to_vec(n)) == expected);
    }
    planar += expected;
    touching += !expected;
  }
  CHECK(planar > 1000);
  CHECK(touching > 1000);
}

TEST_CASE("An ulp decides where a net is degenerate", "[intersect][overlap]") {
  // Edge a-b, and edge c-d from above that ends on it: c is the middle of a-b, moved along the normal.
  const Vec3 n(1, 2, 3), a(-5, 1, 2), b(7, 3, -4), d = Vec3(1, 2, -1) + n.cross(b - a);
  const std::vector<Edge> edges{{0, 1}, {2, 3}};
  const Vec3 above = n.cross(b - a);
  for (const double lift : {0.0, 1.0, 1024.0}) {
    const Vec3 c = 0.5 * (a + b) + lift * n;
    CHECK_FALSE(is_planar_straight_line_graph(std::vector{a, b, c, d}, edges, n));
    for (int axis = 0; axis < 3; ++axis)
      for (const double direction : {-1.0, 1.0}) {
        Vec3 moved = c;
        moved[axis] = std::nextafter(c[axis], direction * std::numeric_limits<double>::infinity());
        CAPTURE(lift, axis, direction);
        CHECK(is_planar_straight_line_graph(std::vector{a, b, moved, d}, edges, n) == (direction * above[axis] > 0));
      }
  }
  // A sliver: neighbours along one line up to an ulp, in order or folded back.
  const std::vector<Edge> chain{{0, 1}, {1, 2}};
  const double up = std::nextafter(1.0, 2.0);
  const Vec3 z(0, 0, 1), first(0, 0, 0), second(1, 1, 5);
  CHECK(is_planar_straight_line_graph(std::vector{first, second, Vec3(2, 2, 0)}, chain, z));
  CHECK_FALSE(is_planar_straight_line_graph(std::vector{first, second, Vec3(0.5, 0.5, 0)}, chain, z));
  CHECK(is_planar_straight_line_graph(std::vector{first, second, Vec3(0.5, 0.5 * up, 0)}, chain, z));
  CHECK_FALSE(is_planar_straight_line_graph(std::vector{first, second, Vec3(1, 1, -7)}, chain, z));
  CHECK(is_planar_straight_line_graph(std::vector{first, second, Vec3(1, up, -7)}, chain, z));
}

TEST_CASE("What is not finite, and planes that are none, are not planar", "[intersect][overlap]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Edge> edges{{0, 1}};
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  CHECK(is_planar_straight_line_graph(points, edges, {0, 0, 1}));
  for (const Vec3& n : {Vec3(0, 0, 0), Vec3(nan, 0, 1), Vec3(0, infinity, 1)})
    CHECK_FALSE(is_planar_straight_line_graph(points, edges, n));
  CHECK_FALSE(is_planar_straight_line_graph(std::vector<Vec3>{{0, 0, 0}, {nan, 0, 0}}, edges, {0, 0, 1}));
  CHECK_FALSE(is_planar_straight_line_graph(std::vector<Vec3>{{0, 0, 0}, {infinity, 0, 0}}, edges, {0, 0, 1}));
}

namespace {

/// A sheet whose face in the middle is regular, and its patch.
template <Scheme S>
struct Middle {
  static constexpr int cells = 5, face = S::face_kind == FaceKind::quad ? 12 : 24;
  ControlMesh mesh = sheet(S::name, cells, cells);

  /// Lattice coordinates about the middle of the middle cell.
  template <class Map>
  explicit Middle(Map map) {
    for (Vec3& p : mesh.positions) p = map(p.x() - 0.5 * cells, p.y() - 0.5 * cells);
  }
};

/// The least Jacobian of the projected limit over samples, and whether the sheet's middle patch is called valid.
template <Scheme S>
struct ProjectionVerdict {
  bool is_valid, is_planar;
  double least, largest;

  explicit ProjectionVerdict(const ControlMesh& mesh, int face, const Vec3* direction = nullptr, int steps = 16) {
    const SchemeSurface<S> surface(mesh);
    const Patch<S> patch = surface.patch(face, 0);
    const Vec3 normal = direction ? *direction : chord_plane_normal(patch);
    is_valid = projects_without_overlap(patch, normal);
    is_planar = is_planar_straight_line_graph(patch.points, patch.configuration->net_edges(), normal);
    least = std::numeric_limits<double>::infinity();
    largest = -least;
    for (int j = 0; j <= steps; ++j)
      for (int i = 0; i <= (S::face_kind == FaceKind::quad ? steps : steps - j); ++i) {
        const LimitSample at = *surface.evaluate({face, 0, double(i) / steps, double(j) / steps});
        if (!at.derivatives) continue;
        const double jacobian = normal.dot(at.derivatives->du.cross(at.derivatives->dv));
        least = std::min(least, jacobian);
        largest = std::max(largest, jacobian);
      }
  }
};

}  // namespace

TEST_CASE("A bent strip is valid in planes that it does not turn away from", "[intersect][overlap]") {
  // Control points on a cylinder at equal angles theta: the spline's tangent at a knot is the circle's at its control
  // point, so the patch over theta is seen without overlap, along a direction at the angle phi from its middle, exactly
  // if phi + theta / 2 < pi / 2. The net of level 3 has steps of theta / 8; its outermost edge is a chord whose middle
  // is theta / 16 beyond the patch.
  constexpr double quarter = std::numbers::pi / 2;
  int valid = 0, left_out = 0;
  for (double theta = 0.05; theta < 1.7; theta += 0.05)
    for (double phi = 0; phi < quarter; phi += 0.03) {
      const auto strip = [&](double x, double y) { return Vec3(std::sin(theta * x), y, std::cos(theta * x)); };
      const Middle<CatmullClark> middle(strip);
      const Vec3 n(std::sin(phi), 0, std::cos(phi));
      const bool is_valid = ProjectionVerdict<CatmullClark>(middle.mesh, middle.face, &n, 1).is_valid;
      CAPTURE(theta, phi);
      if (phi + 9 * theta / 16 > quarter) CHECK_FALSE(is_valid);
      if (phi + 9 * theta / 16 < quarter - 0.03) CHECK(is_valid);
      valid += is_valid;
      left_out += !is_valid && phi + theta / 2 < quarter;
    }
  CHECK(valid > 600);
  CHECK(left_out > 10);
  CHECK(left_out < valid / 10);
}

TEMPLATE_TEST_CASE("The paper's Figure 12: a patch that bulges beyond its chords is split", "[intersect][overlap]",
                   Loop, CatmullClark) {
  // Around the middle, the net goes over a ball by the angle `reach` a step, and on inward beyond a quarter of a turn.
  using S = TestType;
  int valid = 0, split = 0;
  for (const double height : {0.5, 1.0, 3.0})
    for (double reach = 0.1; reach < 2.6; reach += 0.1) {
      const Middle<S> middle([&](double x, double y) {
        const double r = std::hypot(x, y), angle = reach * r;
        const double across = r == 0 ? reach : std::sin(angle) / r;
        return Vec3(across * x, across * y, height * std::cos(angle));
      });
      CAPTURE(reach, height);
      const ProjectionVerdict<S> verdict(middle.mesh, middle.face);
      if (verdict.is_valid) CHECK(verdict.least > 0);
      const SchemeSurface<S> surface(middle.mesh);
      std::size_t parts = 0, resolved = 0;
      const ValidityCounts counts = for_each_valid_part(surface.patch(middle.face, 0), [&](const ValidPart<S>& part) {
        ++parts;
        resolved += part.resolved;
        CHECK(part.resolved == projects_without_overlap(part.patch, part.plane_normal));
        CHECK(part.path.empty() == verdict.is_valid);
      });
      CHECK(counts.parts == parts);
      CHECK(counts.unresolved == parts - resolved);
      CHECK(counts.split == !verdict.is_valid);
      if (reach < 2) CHECK(counts.unresolved == 0);
      valid += verdict.is_valid;
      split += counts.split > 0;
      if (reach < 0.5) CHECK(verdict.is_valid);
    }
  CHECK(valid > 15);
  CHECK(split > 15);
}

TEMPLATE_TEST_CASE("Folded nets are not valid", "[intersect][overlap]", Loop, CatmullClark) {
  using S = TestType;
  const auto flat = [](double x, double y) { return Vec3(x, y, 0.1 * x * y); };
  const Vec3 up(0, 0, 1), down(0, 0, -1), side(1, 0, 0);
  const auto verdict = [&](auto map, const Vec3& n) {
    const Middle<S> middle(map);
    return ProjectionVerdict<S>(middle.mesh, middle.face, &n).is_valid;
  };
  CHECK(verdict(flat, up));
  CHECK_FALSE(verdict(flat, down));
  CHECK_FALSE(verdict(flat, side));
  CHECK_FALSE(verdict([](double x, double y) { return Vec3(-x, y, 0); }, up));
  CHECK_FALSE(verdict([](double x, double y) { return Vec3(std::abs(x), y, x); }, up));
  CHECK_FALSE(verdict([](double x, double y) { return Vec3(x * x, y, x); }, up));
  CHECK_FALSE(verdict([](double x, double) { return Vec3(x, 2 * x, 0); }, up));
  CHECK_FALSE(verdict([](double, double) { return Vec3(0, 0, 0); }, up));
  // A double cover of the plane around the patch's middle: locally fine but for one point.
  CHECK_FALSE(verdict([](double x, double y) { return Vec3(x * x - y * y, 2 * x * y, x); }, up));
}

TEMPLATE_TEST_CASE("A planar net may have a limit that folds", "[intersect][overlap]", Loop, CatmullClark) {
  // Random steps that lower the least Jacobian, compared with the largest, and keep the net planar.
  using S = TestType;
  const Vec3 up(0, 0, 1);
  Random random(4);
  Middle<S> middle([&](double x, double y) { return Vec3(x, y, 0.1 * x * x); });
  ProjectionVerdict<S> now(middle.mesh, middle.face, &up, 8);
  REQUIRE(now.is_valid);
  int refused = 0;
  for (int round = 0; round < 6000 && now.least > -0.001 * now.largest; ++round) {
    ControlMesh next = middle.mesh;
    const int steps = 1 + random.index(3);
    for (int i = 0; i < steps; ++i) {
      Vec3& p = next.positions[static_cast<std::size_t>(random.index(static_cast<int>(next.positions.size())))];
      const double reach = random.uniform(0, 0.5);
      p += reach * random.point();
    }
    const ProjectionVerdict<S> then(next, middle.face, &up, 8);
    if (then.is_valid) REQUIRE(then.least > 0);
    refused += !then.is_valid;
    if (!then.is_planar || then.least * now.largest > now.least * then.largest) continue;
    middle.mesh = next;
    now = then;
  }
  CHECK(refused > 0);
  CHECK(now.is_planar);
  CHECK(now.least < 0);
  CHECK_FALSE(now.is_valid);
}

TEMPLATE_TEST_CASE("Nothing that is called valid folds", "[intersect][overlap][sweep]", Loop, CatmullClark) {
  using S = TestType;
  check_property([] {
    std::array<Vec3, 8> offsets;
    for (Vec3& offset : offsets) offset = *any_point();
    for (const int n : {3, 4, 5, 6, 9}) {
      ControlMesh mesh = poles(S::name, n);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] += 0.1 * offsets[i % offsets.size()];
      for (const int face : {0, 1}) {
        const ProjectionVerdict<S> verdict(mesh, face);
        if (verdict.is_valid) RC_ASSERT(verdict.least > 0);
      }
    }
  });
}

TEST_CASE("Slivers are valid as long as rounding cannot fold them", "[intersect][overlap]") {
  const Vec3 up(0, 0, 1);
  for (int exponent = 0; exponent <= 60; ++exponent) {
    const double width = std::ldexp(1.0, -exponent);
    CAPTURE(exponent);
    const Middle<CatmullClark> even([&](double x, double y) { return Vec3(x, width * y + x, 0.25 * x * x); });
    const ProjectionVerdict<CatmullClark> verdict(even.mesh, even.face, &up);
    if (exponent <= 30) CHECK(verdict.is_valid);
    if (exponent >= 50) CHECK_FALSE(verdict.is_valid);
    // Turned over by as little.
    const Middle<CatmullClark> turned([&](double x, double y) { return Vec3(x, -width * y + x, 0.25 * x * x); });
    CHECK_FALSE(ProjectionVerdict<CatmullClark>(turned.mesh, turned.face, &up).is_valid);
  }
}

TEST_CASE("What lies beyond sharp edges does not make a cube overlap", "[intersect][overlap]") {
  ControlMesh mesh = cube();
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int i = 0; i < 4; ++i) {
      const auto face = mesh.face(f);
      const int a = face[static_cast<std::size_t>(i)], b = face[static_cast<std::size_t>((i + 1) % 4)];
      if (a < b) mesh.sharp_edges.push_back({a, b, infinite_sharpness});
    }
  const auto counts = [](const ControlMesh& control) {
    const SchemeSurface<CatmullClark> surface(control);
    ValidityCounts total;
    for (int f = 0; f < surface.face_count(); ++f)
      total += for_each_valid_part(surface.patch(f, 0), [](const auto&) {});
    return total;
  };
  const ValidityCounts sharp = counts(mesh);
  CHECK(sharp.patches == 6);
  CHECK(sharp.split == 0);
  CHECK(sharp.parts == 6);
  for (const float sharpness : {0.5f, 1.0f, 1.7f, 2.0f, 3.0f, 4.5f}) {
    ControlMesh softer = shaken(mesh, 0.1);
    for (SharpEdge& edge : softer.sharp_edges) edge.sharpness = sharpness;
    CAPTURE(sharpness);
    CHECK(counts(softer).unresolved == 0);
  }
  // Around the bottom only: a smooth curve with one face inside, where the surface narrows to the curve at each corner.
  const ControlMesh mixed = with_edges(shaken(cube(), 0.1), {{0, 1, 10}, {1, 2, 10}, {2, 3, 10}, {3, 0, 10}});
  CHECK(counts(mixed).unresolved <= 4);
}

TEST_CASE("Bilinear patches are valid where their outline is convex", "[intersect][overlap]") {
  const Vec3 up(0, 0, 1);
  const auto is_valid = [&](const Vec3& corner) {
    const SchemeSurface<Bilinear> surface(mesh_of({{0, 0, 0}, {2, 0, 1}, corner, {0, 2, 3}}, {{0, 1, 2, 3}}));
    return projects_without_overlap(surface.patch(0, 0), up);
  };
  CHECK(is_valid({2, 2, 0}));
  CHECK(is_valid({1.01, 1.01, -2}));
  CHECK_FALSE(is_valid({1, 1, 5}));
  CHECK_FALSE(is_valid({0.9, 0.9, 5}));
  CHECK_FALSE(is_valid({-1, -1, 5}));
}

}  // namespace shaolin
