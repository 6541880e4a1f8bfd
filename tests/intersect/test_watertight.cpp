// Rays aimed exactly at what patches share: vertices, edges, extraordinary points. None may slip through.
#include "tests/catch.h"
#include "tests/intersect/aimed_rays.h"

namespace shaolin {

namespace {

struct Aim {
  const Scene& scene;
  double diagonal;
  int rays = 0, lost = 0, beyond = 0, faults = 0;
  std::uint64_t most_cells = 0;  ///< that a ray asked
  std::string first_fault;

  Aim(const Scene& of, double size) : scene(of), diagonal(size) {}

  /// A ray through a point of the surface, from `diagonals` times the model's size away.
  void shoot(const SurfaceParameter& at, const Vec3& direction, double diagonals) {
    const double distance = diagonals * diagonal;
    const LimitSample target = *scene.surface().evaluate(at);
    const Ray ray = ray_at(target.position, direction, distance);
    // Rounding moves the hit along a ray by as much more as the ray grazes; a tangent one by the root of it.
    const double cosine = std::max(std::abs(target.normal.dot(direction)), 1e-6);
    const double allowed = 1e-12 * (distance + diagonal) / cosine;
    const std::uint64_t cells_before = scene.statistics().cells;
    const std::optional<Hit> hit = scene.intersect(ray);
    most_cells = std::max(most_cells, scene.statistics().cells - cells_before);
    ++rays;
    std::string fault;
    if (!hit) {
      ++lost;
      fault = "lost";
    } else if (hit->t > distance + allowed) {
      ++beyond;
      fault = "beyond";
    } else {
      fault = fault_of(scene, ray, *hit, diagonal);
      faults += !fault.empty();
    }
    if (!fault.empty() && first_fault.empty()) {
      std::ostringstream text;
      text.precision(17);
      text << fault << (hit ? " at t " + std::to_string(hit->t) : "") << ": face " << at.face << " sub " << at.sub
           << " u " << at.u << " v " << at.v << " direction " << direction.transpose() << " distance " << distance;
      first_fault = text.str();
    }
  }

  void check() const {
    INFO(first_fault);
    CAPTURE(rays, lost, beyond, faults);
    CHECK(most_cells < 1'000'000);  // rays within tangent planes; 655,000 are known, without end was the bug
    CHECK(lost == 0);
    CHECK(beyond == 0);
    CHECK(faults == 0);
  }
};

/// Directions that go wrong first: along the axes, along the normal, within the tangent plane, then anywhere.
std::vector<Vec3> directions_at(const LimitSample& sample, Random& random, int more) {
  std::vector<Vec3> result{Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
  if (std::abs(sample.normal.norm() - 1) < 1e-9) {  // else the surface has no tangent plane there
    result.push_back(-sample.normal);
    result.push_back(sample.normal.cross(random.direction()).normalized());
  }
  for (int i = 0; i < more; ++i) result.push_back(random.direction());
  return result;
}

/// Calls shoot(aim, scene, face, sub, random) for the patches of about 300 faces of every model; all rays must hit.
template <class Shoot>
void check_all_models(std::uint64_t seed, Shoot shoot) {
  for (const Model& model : all_models()) {
    CAPTURE(model.name, model.scheme);
    const Scene scene(model.mesh, model.scheme);
    Random random(seed);
    Aim aim(scene, model.mesh.diagonal());
    const int stride = 1 + scene.surface().face_count() / 300;
    for_each_patch(scene.surface(), [&](int face, int sub) {
      if (face % stride == 0) shoot(aim, scene.surface(), face, sub, random);
    });
    aim.check();
  }
}

}  // namespace

TEST_CASE("No ray aimed at a corner of a patch is lost", "[intersect][shaolin][sweep]") {
  check_all_models(7, [](Aim& aim, const LimitSurface& surface, int face, int sub, Random& random) {
    for (const auto& corner : domain_corners(surface)) {
      const SurfaceParameter at{face, sub, corner[0], corner[1]};
      for (const Vec3& d : directions_at(*surface.evaluate(at), random, 3)) aim.shoot(at, d, random.uniform(0.5, 3));
    }
  });
}

TEST_CASE("No ray aimed at a point of an edge is lost", "[intersect][shaolin][sweep]") {
  check_all_models(8, [](Aim& aim, const LimitSurface& surface, int face, int sub, Random& random) {
    for (std::size_t k = 0; k < domain_corners(surface).size(); ++k)
      for (const double along : {0.5, random.uniform(), 1e-3 * random.uniform(), 1e-9}) {
        const SurfaceParameter at = on_side(surface, face, sub, k, along);
        const LimitSample sample = *surface.evaluate(at);
        for (const Vec3& d : directions_at(sample, random, 1)) aim.shoot(at, d, random.uniform(0.5, 3));
      }
  });
}

}  // namespace shaolin
