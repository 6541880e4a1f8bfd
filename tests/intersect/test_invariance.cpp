// Moving, scaling, mirroring or renumbering the world moves, scales, mirrors or renumbers the hits.
#include <numeric>

#include "schemes/limit_surface.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// Both schemes, closed and open, with poles, creases and n-gons; no symmetry left.
std::vector<Model> small_models() {
  std::vector<Model> models{{"torus", "catmark", shaken(torus("catmark", 4, 6), 0.1)},
                            {"torus", "loop", shaken(torus("loop", 4, 6), 0.1)},
                            {"poles", "catmark", shaken(poles("catmark", 5), 0.2)},
                            {"poles", "loop", shaken(poles("loop", 9), 0.2)},
                            {"prism", "catmark", shaken(prism(5), 0.1)},
                            {"fan", "loop", shaken(fan("loop", 4), 0.2)}};
  models[2].mesh.sharp_edges = {{0, 2, 10}, {0, 6, 1.5}};
  models[3].mesh.sharp_edges = {{0, 2, 10}, {0, 6, 10}, {1, 3, 2.5}};
  models[3].mesh.sharp_vertices = {{1, 1.5}};
  return models;
}

/// Two answers that must be alike: the second is of a world in which lengths are `scale` times as large.
struct Comparison {
  int hits = 0, differ = 0;
  double worst = 0;  ///< of t, in units of the diagonal, for rays that do not graze

  void add(const std::optional<Hit>& a, const std::optional<Hit>& b, const Ray& ray, double scale, double diagonal) {
    hits += a.has_value();
    // A ray that grazes may miss where rounding moves the surface, and slides along it: by 1 / cosine.
    const auto cosine = [&](const std::optional<Hit>& hit) {
      return hit ? std::abs(hit->sample.normal.dot(ray.direction.normalized())) : 1;
    };
    if (a.has_value() != b.has_value()) {
      differ += std::min(cosine(a), 1.0) > 1e-4;
      return;
    }
    if (!a || cosine(a) < 1e-3) return;
    const double distance = std::abs(a->t - b->t / scale) * ray.direction.norm();
    worst = std::max(worst, distance * cosine(a) / diagonal);
  }
};

/// The mesh and the rays mapped by p -> factor p + shift, against the originals.
Comparison compare(const Model& model, double factor, const Vec3& shift) {
  const Scene scene(model.mesh, model.scheme);
  ControlMesh mapped = model.mesh;
  for (Vec3& p : mapped.positions) p = factor * p + shift;
  const Scene other(mapped, model.scheme);
  Comparison comparison;
  for (const Ray& ray : random_rays(scene.bounds(), 300, 71)) {
    // The direction stays, so t grows by the factor.
    const Ray moved{factor * ray.origin + shift, ray.direction, factor * ray.tmin, ray.tmax};
    comparison.add(scene.intersect(ray), other.intersect(moved), ray, factor, model.mesh.diagonal());
  }
  return comparison;
}

}  // namespace

// Squares of areas must not leave the range of doubles: 2^200 is far from that, 2^260 is not.
TEST_CASE("Scaling by a power of two changes no digit", "[intersect][invariance]") {
  for (const Model& model : small_models()) {
    const Scene scene(model.mesh, model.scheme);
    for (const int exponent : {-200, -40, -1, 1, 40, 200}) {
      CAPTURE(model.name, model.scheme, exponent);
      const double factor = std::ldexp(1, exponent);
      ControlMesh mapped = model.mesh;
      for (Vec3& p : mapped.positions) p *= factor;
      const Scene other(mapped, model.scheme);
      int hits = 0, differ = 0;
      for (const Ray& ray : random_rays(scene.bounds(), 200, 72)) {
        const auto a = scene.intersect(ray);
        const auto b = other.intersect({factor * ray.origin, factor * ray.direction});
        hits += a.has_value();
        differ += a.has_value() != b.has_value();
        if (!a || !b) continue;
        differ += a->t != b->t || a->sample.position * factor != b->sample.position || a->at.face != b->at.face ||
                  a->at.u != b->at.u || a->at.v != b->at.v || a->level != b->level;
      }
      CHECK(hits > 10);
      CHECK(differ == 0);
    }
  }
}

TEST_CASE("Scaling beyond the range of squared areas loses no hit", "[intersect][invariance]") {
  for (const Model& model : small_models())
    for (const int exponent : {-500, -300, 300, 500}) {
      CAPTURE(model.name, model.scheme, exponent);
      const Comparison comparison = compare(model, std::ldexp(1, exponent), Vec3::Zero());
      CHECK(comparison.hits > 15);
      CHECK(comparison.differ == 0);
      CHECK(comparison.worst < 1e-12);
    }
}

TEST_CASE("Scaling by other numbers changes the last digits", "[intersect][invariance]") {
  for (const Model& model : small_models())
    for (const double factor : {1e-12, 0.1, 3.0, 1e12}) {
      CAPTURE(model.name, model.scheme, factor);
      const Comparison comparison = compare(model, factor, Vec3::Zero());
      CHECK(comparison.hits > 15);
      CHECK(comparison.differ == 0);
      CHECK(comparison.worst < 1e-12);
    }
}

TEST_CASE("Moving the world costs the digits of its coordinates", "[intersect][invariance]") {
  for (const Model& model : small_models())
    for (const double by : {1e3, 1e6}) {
      CAPTURE(model.name, model.scheme, by);
      const Comparison comparison = compare(model, 1, by * Vec3(0.7, -1, 0.4));
      CHECK(comparison.hits > 15);
      CHECK(comparison.differ == 0);
      // Positions and origins round at u times the shift; the hit within RayFrame::error, 224 u of it.
      CHECK(comparison.worst < 256 * unit_roundoff * by / model.mesh.diagonal());
    }
}

TEST_CASE("Permuted faces and turned corners give the same positions", "[intersect][invariance]") {
  Random random(73);
  for (const Model& model : small_models()) {
    CAPTURE(model.name, model.scheme);
    ControlMesh mixed = model.mesh;
    mixed.face_offsets = {0};
    mixed.face_vertices.clear();
    std::vector<int> order(static_cast<std::size_t>(model.mesh.face_count()));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[static_cast<std::size_t>(random.index(static_cast<int>(i)))]);
    for (const int face : order) {
      std::vector<int> corners(model.mesh.face(face).begin(), model.mesh.face(face).end());
      std::rotate(corners.begin(), corners.begin() + random.index(static_cast<int>(corners.size())), corners.end());
      mixed.add_face(corners);
    }
    const Scene scene(model.mesh, model.scheme), other(mixed, model.scheme);
    Comparison comparison;
    int other_face = 0;
    for (const Ray& ray : random_rays(scene.bounds(), 300, 74)) {
      const auto a = scene.intersect(ray), b = other.intersect(ray);
      comparison.add(a, b, ray, 1, model.mesh.diagonal());
      // At an edge either face may answer: count those, random rays meet none.
      if (a && b) other_face += order[static_cast<std::size_t>(b->at.face)] != a->at.face;
    }
    CHECK(comparison.hits > 15);
    CHECK(comparison.differ == 0);
    CHECK(comparison.worst < 1e-13);
    CHECK(other_face == 0);
  }
}

TEST_CASE("A mirrored mesh gives mirrored hits", "[intersect][invariance]") {
  for (const Model& model : small_models())
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      CAPTURE(model.name, model.scheme, axis);
      const auto mirrored = [&](Vec3 p) {
        p[axis] = -p[axis];
        return p;
      };
      ControlMesh mesh = model.mesh;
      for (Vec3& p : mesh.positions) p = mirrored(p);
      const Scene scene(model.mesh, model.scheme), other(mesh, model.scheme);
      Comparison comparison;
      double position = 0, normal = 0;
      for (const Ray& ray : random_rays(scene.bounds(), 200, 75)) {
        const auto a = scene.intersect(ray), b = other.intersect({mirrored(ray.origin), mirrored(ray.direction)});
        comparison.add(a, b, ray, 1, model.mesh.diagonal());
        if (!a || !b || std::abs(a->sample.normal.dot(ray.direction.normalized())) < 1e-3) continue;
        position = std::max(position, (a->sample.position - mirrored(b->sample.position)).norm());
        // The faces keep their order of corners, so du x dv turns around.
        normal = std::max(normal, (a->sample.normal + mirrored(b->sample.normal)).norm());
      }
      CHECK(comparison.hits > 10);
      CHECK(comparison.differ == 0);
      CHECK(comparison.worst < 1e-13);
      CHECK(position < 1e-10 * model.mesh.diagonal());
      CHECK(normal < 1e-8);
    }
}

}  // namespace shaolin
