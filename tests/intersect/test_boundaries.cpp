// Where a surface ends: the three boundary modes, holes, and rays on and beside the rim.
#include <map>

#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/infinity.h"
#include "tests/intersect/aimed_rays.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// True if the ray straight down at (x, y) hits; the plane z = 0 is met at t = 1.
bool down_hits(const Scene& scene, double x, double y) {
  const Ray ray{{x, y, 1}, {0, 0, -1}, 0, infinity};
  const auto hit = scene.intersect(ray);
  CHECK(scene.occluded(ray) == hit.has_value());
  if (hit) CHECK(std::abs(hit->t - 1) < 1e-13);
  return hit.has_value();
}

/// The faces' sides that no other face has.
std::vector<std::pair<int, std::size_t>> rim(const ControlMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  const auto key = [&](int face, std::size_t k) {
    const auto v = mesh.face(face);
    return std::minmax<int>({v[k], v[(k + 1) % v.size()]});
  };
  std::vector<std::pair<int, std::size_t>> result;
  for (const bool counting : {true, false})
    for (int face = 0; face < mesh.face_count(); ++face)
      for (std::size_t k = 0; k < mesh.face(face).size(); ++k) {
        if (counting) ++uses[key(face, k)];
        if (!counting && uses[key(face, k)] == 1) result.push_back({face, k});
      }
  return result;
}

/// The unit vector out of the surface at side k: in its tangent plane, across the side.
Vec3 outward(const LimitSurface& surface, const LimitSample& sample, std::size_t k) {
  const Derivatives& d = *sample.derivatives;
  Vec3 along, out;
  if (surface.triangular()) {
    along = std::array<Vec3, 3>{d.du, d.dv - d.du, d.dv}[k];
    out = std::array<Vec3, 3>{-d.dv, d.du, -d.du}[k];
  } else {
    along = k % 2 ? d.dv : d.du;
    out = std::array<Vec3, 4>{-d.dv, d.du, d.dv, -d.du}[k];
  }
  along.normalize();
  return (out - out.dot(along) * along).normalized();
}

/// The nearest hit that is not on one of the given faces, by asking on behind those.
std::optional<Hit> hit_elsewhere(const Scene& scene, Ray ray, const std::vector<char>& left_out) {
  for (;;) {
    const auto hit = scene.intersect(ray);
    if (!hit || !left_out[static_cast<std::size_t>(hit->at.face)]) return hit;
    ray.tmin = hit->t + 1e-9;
  }
}

/// `part` is the surface of `whole` without some faces: every ray meets the rest of `whole` there.
void check_rest(const ControlMesh& whole_mesh, const ControlMesh& part_mesh, const std::string& scheme) {
  const Scene whole(whole_mesh, scheme), part(part_mesh, scheme);
  std::vector<char> left_out;
  for (int face = 0; face < part_mesh.face_count(); ++face) {
    left_out.push_back(!part.surface().has_limit(face));
    if (left_out.back()) CHECK(!part.surface().evaluate({face, 0, 0.25, 0.25}));
  }
  int through = 0, hits = 0;
  for (const Ray& ray : random_rays(whole.bounds(), 500, 81)) {
    CAPTURE(scheme, ray.origin.transpose(), ray.direction.transpose());
    const auto nearest = whole.intersect(ray), expected = hit_elsewhere(whole, ray, left_out),
               hit = part.intersect(ray);
    through += nearest && left_out[static_cast<std::size_t>(nearest->at.face)];
    hits += hit.has_value();
    REQUIRE(hit.has_value() == expected.has_value());
    CHECK(part.occluded(ray) == hit.has_value());
    if (!hit) continue;
    CHECK(std::abs(hit->t - expected->t) < 1e-11);
    CHECK(hit->at.face == expected->at.face);
  }
  CHECK(through > 10);
  CHECK(hits > 15);
}

}  // namespace

TEST_CASE("A flat sheet ends where its boundary mode says", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    CAPTURE(scheme);
    const ControlMesh mesh = sheet(scheme, 4, 4);
    const Scene corners(with_boundary(mesh, BoundaryInterpolation::edge_and_corner), scheme);
    const Scene edges(with_boundary(mesh, BoundaryInterpolation::edge_only), scheme);
    const Scene none(with_boundary(mesh, BoundaryInterpolation::none), scheme);
    for (const Scene* scene : {&corners, &edges, &none}) {
      CHECK(down_hits(*scene, 2, 2));
      CHECK(down_hits(*scene, 1, 1));
      CHECK(down_hits(*scene, 3, 1.7));
      CHECK(!down_hits(*scene, -1e-9, 2));
      CHECK(!down_hits(*scene, 2, 4 + 1e-9));
    }
    for (const double along : {1.0, 1.3, 2.0, 3.0})
      for (const double in : {0.0, 1e-12, 1e-3, 0.5, 1 - 1e-9}) {
        CAPTURE(along, in);
        for (const Scene* scene : {&corners, &edges}) {
          CHECK(down_hits(*scene, along, in));
          CHECK(down_hits(*scene, 4 - in, along));
        }
        CHECK(!down_hits(none, along, in));
        CHECK(!down_hits(none, 4 - in, along));
      }
    // Vertices with one face: sharp, or rounded off. Loop's sheet has such at (4, 0) and (0, 4), quads' at all four.
    CHECK(down_hits(corners, 4, 0));
    CHECK(down_hits(corners, 0, 4));
    CHECK(down_hits(corners, 4 - 1e-9, 1e-9));
    CHECK(!down_hits(edges, 4, 0));
    CHECK(!down_hits(edges, 0, 4));
    // The boundary is a cubic spline, so it passes (1 4 1) / 6 of the rim's points at the vertex.
    const double sixth = 1.0 / 6;
    CHECK(down_hits(edges, 4 - sixth, sixth));
    CHECK(down_hits(edges, 4 - sixth - 1e-9, sixth + 1e-9));
    CHECK(!down_hits(edges, 4 - sixth + 1e-9, sixth - 1e-9));
  }
}

TEST_CASE("A boundary that is tagged sharp needs no mode", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    const ControlMesh mesh = shaken(sheet(scheme, 3, 4), 0.2);
    ControlMesh tagged = with_boundary(mesh, BoundaryInterpolation::none);
    for (const auto& [face, k] : rim(mesh)) {
      const auto v = mesh.face(face);
      tagged.sharp_edges.push_back({v[k], v[(k + 1) % v.size()], infinite_sharpness});
    }
    const Scene edges(with_boundary(mesh, BoundaryInterpolation::edge_only), scheme), tags(tagged, scheme);
    int hits = 0;
    for (const Ray& ray : random_rays(edges.bounds(), 300, 82)) {
      const auto hit = edges.intersect(ray);
      hits += hit.has_value();
      CHECK(same(hit, tags.intersect(ray)));
    }
    CHECK(hits > 50);
  }
}

TEST_CASE("Rays hit the rim and miss beside it", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"})
    for (const auto mode : {BoundaryInterpolation::edge_only, BoundaryInterpolation::edge_and_corner}) {
      const ControlMesh mesh = with_boundary(shaken(sheet(scheme, 4, 3), 0.15), mode);
      const Scene scene(mesh, scheme);
      Random random(83);
      for (const auto& [face, k] : rim(mesh))
        for (int i = 0; i < 10; ++i) {
          const SurfaceParameter at = on_side(scene.surface(), face, 0, k, random.uniform(0.05, 0.95));
          const LimitSample sample = *scene.surface().evaluate(at);
          const Vec3 out = outward(scene.surface(), sample, k);
          CAPTURE(scheme, face, k, at.u, at.v);
          const auto hit = scene.intersect(ray_at(sample.position, sample.normal, 1));
          REQUIRE(hit);
          CHECK(std::abs(hit->t - 1) < 1e-12);
          // The rim curves by less than 1e-9 over 1e-5, and this sheet has no other part above or below.
          CHECK(scene.intersect(ray_at(sample.position - 1e-5 * out, sample.normal, 1)));
          CHECK(!scene.intersect(ray_at(sample.position + 1e-5 * out, sample.normal, 1)));
          CHECK(!scene.occluded(ray_at(sample.position + 1e-5 * out, sample.normal, 1)));
        }
    }
}

TEST_CASE("Rays pass through holes and meet the rest", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"})
    for (const ControlMesh& whole : {shaken(torus(scheme, 4, 5), 0.1), shaken(poles(scheme, 6), 0.1)}) {
      ControlMesh part = whole;
      part.holes = {0, 3, 4};  // neighbours and others
      check_rest(whole, part, scheme);
    }
  const ControlMesh body = shaken(prism(5), 0.1);
  ControlMesh part = body;
  part.holes = {1, 2};  // a pentagon beside a quad
  check_rest(body, part, "catmark");
}

TEST_CASE("Rays pass through faces without limit and meet the rest", "[intersect][boundaries]") {
  // A face away from the rim has the same surface in every mode: only its own ring of points shapes it.
  for (const std::string scheme : {"loop", "catmark"}) {
    const ControlMesh mesh = shaken(sheet(scheme, 5, 5), 0.2);
    check_rest(mesh, with_boundary(mesh, BoundaryInterpolation::none), scheme);
  }
}

TEST_CASE("Rays at the rim of a hole hit", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    ControlMesh mesh = shaken(poles(scheme, 5), 0.1);
    const auto whole = make_limit_surface(mesh, scheme);
    mesh.holes = {0};
    const Scene scene(mesh, scheme);
    Random random(84);
    for (std::size_t k = 0; k < mesh.face(0).size(); ++k)
      for (const double along : {0.0, 1e-9, 0.5, random.uniform()}) {
        const LimitSample sample = *whole->evaluate(on_side(*whole, 0, 0, k, along));
        for (int i = 0; i < 5; ++i) {
          const Vec3 direction = (0.5 * random.point() - sample.normal).normalized();
          const auto hit = scene.intersect(ray_at(sample.position, direction, 5));
          CAPTURE(scheme, k, along, direction.transpose());
          REQUIRE(hit);
          CHECK(hit->t < 5 + 1e-11);
          CHECK(hit->at.face != 0);
        }
      }
  }
}

TEST_CASE("A surface without any limit face is met by no ray", "[intersect][boundaries]") {
  for (const std::string scheme : {"loop", "catmark"}) {
    const Scene scene(with_boundary(sheet(scheme, 1, 1), BoundaryInterpolation::none), scheme);
    CHECK(scene.statistics().faces == 0);
    CHECK(!down_hits(scene, 0.4, 0.3));
    ControlMesh closed = poles(scheme, 3);
    for (int face = 0; face < closed.face_count(); ++face) closed.holes.push_back(face);
    CHECK(!down_hits(Scene(closed, scheme), 0, 0));
  }
}

}  // namespace shaolin
