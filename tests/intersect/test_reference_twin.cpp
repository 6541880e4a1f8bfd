// A slow reference twin: global refinement, limit points, and every triangle asked in a loop.
#include <array>

#include "schemes/builtin.h"
#include "schemes/scheme_surface.h"
#include "tests/catch.h"
#include "tests/intersect/random_rays.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// Triangles between limit points, and how far the surface may be from them.
struct TwinTessellation {
  std::vector<std::array<Vec3, 3>> triangles;
  double sagitta = 0;

  void add(const std::array<Vec3, 3>& triangle) { triangles.push_back(triangle); }
};

/// The limit points of all vertices that a face with a limit has.
template <Scheme S>
std::vector<Vec3> limit_points(const SubdivisionMesh<S>& mesh) {
  std::vector<Vec3> result(static_cast<std::size_t>(mesh.vertex_count()), Vec3::Zero());
  std::vector<char> known(result.size());
  for (const int f : mesh.faces())
    for (int k = 0; mesh.has_limit(f) && k < mesh.face_size(f); ++k) {
      const auto v = static_cast<std::size_t>(mesh.face(f)[static_cast<std::size_t>(k)]);
      if (!known[v]) result[v] = mesh.limit(f, k).position;
      known[v] = true;
    }
  return result;
}

/// The distance of a point from a triangle: from its plane if the foot lies inside, else from its sides.
double distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  double best = std::numeric_limits<double>::infinity();
  bool inside = normal.norm() > 0;
  for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
    const Vec3 side = to - from;
    inside = inside && normal.dot(side.cross(p - from)) >= 0;
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp(side.dot(p - from) / length, 0.0, 1.0) : 0;
    best = std::min(best, (p - from - along * side).norm());
  }
  return inside ? std::abs(normal.dot(p - a)) / normal.norm() : best;
}

/// The surface after `levels` steps. The last step moved points off the triangles before it by some distance; each
/// further step moves them by a quarter of that where the surface is smooth, by no more than two thirds around a vertex
/// of any valence: all further steps together by no more than twice the last. That is the sagitta.
template <Scheme S>
TwinTessellation tessellate(const ControlMesh& control, const S& scheme, int levels) {
  std::vector<std::unique_ptr<SubdivisionMesh<S>>> meshes;
  meshes.push_back(std::make_unique<SubdivisionMesh<S>>(control, scheme));
  for (int level = 0; level < levels; ++level) meshes.push_back(meshes.back()->refine());
  const SubdivisionMesh<S>&fine = *meshes.back(), &coarse = *fine.parent();
  const std::vector<Vec3> points = limit_points(fine);
  const auto at = [&](int vertex) -> const Vec3& { return points[static_cast<std::size_t>(vertex)]; };

  TwinTessellation result;
  for (const int f : fine.faces()) {
    if (!fine.has_limit(f)) continue;
    const std::span<const int> v = fine.face(f);
    result.add({at(v[0]), at(v[1]), at(v[2])});
    if (v.size() == 4) result.add({at(v[0]), at(v[2]), at(v[3])});
  }
  result.sagitta = 1e-9 * control.diagonal();  // a flat surface's: covers the widened edges and all rounding
  // Corner k of a face stands at place k of its child k, and the new points behind it. A point between two faces counts
  // from the nearer.
  std::vector<double> moved(points.size(), std::numeric_limits<double>::infinity());
  for (const int f : coarse.faces()) {
    if (!coarse.has_limit(f)) continue;
    const auto v = coarse.face(f);
    const std::size_t n = v.size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto child = fine.face(coarse.child_face(f, static_cast<int>(k)));
      for (std::size_t i = k + 1; i < k + n; ++i) {
        const int vertex = child[i % n];
        double& least = moved[static_cast<std::size_t>(vertex)];
        least = std::min(least, distance(at(vertex), at(v[0]), at(v[1]), at(v[2])));
        if (n == 4) least = std::min(least, distance(at(vertex), at(v[0]), at(v[2]), at(v[3])));
      }
    }
  }
  for (const double by : moved)
    if (std::isfinite(by)) result.sagitta = std::max(result.sagitta, 2 * by);
  return result;
}

/// The nearest t >= 0 at which a ray meets a triangle (Moeller, Trumbore 1997), or infinity. Edges are widened by 1e-9:
/// here a hit twice does no harm, one lost does.
double nearest(const TwinTessellation& tessellation, const Vec3& origin, const Vec3& direction) {
  constexpr double wide = 1e-9;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : tessellation.triangles) {
    const Vec3 ab = b - a, ac = c - a, p = direction.cross(ac);
    const double determinant = ab.dot(p);
    if (determinant == 0) continue;
    const Vec3 s = origin - a, q = s.cross(ab);
    const double u = s.dot(p) / determinant, v = direction.dot(q) / determinant, t = ac.dot(q) / determinant;
    if (u >= -wide && v >= -wide && u + v <= 1 + wide && t >= 0 && t < best) best = t;
  }
  return best;
}

/// What the twin says of a ray through the surface, which lies within the sagitta s of the triangles: parallel rays at
/// 2 s to four sides bracket the answer. Where the triangles lean by an angle a, these differ from the middle one by at
/// least 2 s tan(a) cos(45 degrees), and the surface by no more than s / cos(a) <= s + s tan(a).
struct TwinVerdict {
  int met = 0;
  double low = std::numeric_limits<double>::infinity(), high = 0;

  TwinVerdict(const TwinTessellation& tessellation, const Ray& ray) {
    const double s = tessellation.sagitta;
    const Vec3 direction = ray.direction.normalized(), x = direction.unitOrthogonal(), y = direction.cross(x);
    for (const Vec3& aside : {Vec3(0, 0, 0), x, Vec3(-x), y, Vec3(-y)}) {
      const double t = nearest(tessellation, ray.origin + 2 * s * aside, direction);
      if (!std::isfinite(t)) continue;
      ++met;
      low = std::min(low, t - s);
      high = std::max(high, t + s);
    }
  }
  bool misses() const { return met == 0; }
  /// Steeper than about 1 : 10, or astride a silhouette: then the bracket says little.
  bool hits(double s) const { return met == 5 && high - low < 40 * s; }
};

void compare(const Model& model, int levels, int count, double most_undecided) {
  CAPTURE(model.name, model.scheme);
  const TwinTessellation twin =
      with_scheme(model.scheme, [&]<Scheme S>(const S& scheme) { return tessellate(model.mesh, scheme, levels); });
  const Scene scene(model.mesh, model.scheme);
  int undecided = 0, hits = 0;
  Box around;  // aims depend on the model alone, not on how closely it is bounded
  for (const Vec3& point : model.mesh.positions) around.add(point);
  for (Ray ray : random_rays(around, count, 41)) {
    ray.direction.normalize();
    const TwinVerdict verdict(twin, ray);
    const auto hit = scene.intersect(ray);
    CAPTURE(ray.origin.transpose(), ray.direction.transpose(), twin.sagitta, verdict.low, verdict.high);
    if (verdict.misses()) {
      CHECK(!hit);
    } else if (verdict.hits(twin.sagitta)) {
      ++hits;
      REQUIRE(hit);
      CHECK(hit->t >= verdict.low);
      CHECK(hit->t <= verdict.high);
    } else {
      ++undecided;
    }
  }
  CAPTURE(hits, undecided, twin.sagitta / model.mesh.diagonal());
  CHECK(twin.sagitta < 0.01 * model.mesh.diagonal());
  CHECK(hits > count / 20);
  CHECK(undecided <= most_undecided * count);
}

}  // namespace

TEST_CASE("Rays meet what a fine tessellation meets", "[intersect][scene][sweep]") {
  const std::vector<Model> small{{"torus", "catmark", shaken(torus("catmark", 4, 6), 0.1)},
                                 {"torus", "loop", shaken(torus("loop", 4, 6), 0.1)},
                                 {"poles", "catmark", shaken(poles("catmark", 5), 0.2)},
                                 {"poles", "loop", shaken(poles("loop", 8), 0.2)},
                                 {"prism", "catmark", shaken(prism(6), 0.1)},
                                 {"fan", "catmark", shaken(fan("catmark", 3), 0.2)},
                                 {"fan", "loop", shaken(fan("loop", 4), 0.2)},
                                 {"poles", "warren", shaken(poles("loop", 5), 0.2)},
                                 {"prism", "bilinear", shaken(prism(5), 0.1)},
                                 {"poles", "linear", shaken(poles("loop", 6), 0.2)}};
  for (const Model& model : small) compare(model, 5, 400, 0.1);
}

TEST_CASE("Rays meet what a fine tessellation of a model meets", "[intersect][scene][sweep]") {
  int unrefined = 0;  // refine() cannot hold a Loop mesh with an inner vertex of valence 2
  for (const Model& model : all_models()) {
    if (model.mesh.face_count() > 700) continue;  // the twin's time is rays x triangles
    const int levels = model.mesh.face_count() > 200 ? 3 : model.mesh.face_count() > 40 ? 4 : 5;
    try {
      compare(model, levels, 150, 0.2);
    } catch (const InputError&) {
      ++unrefined;
    }
  }
  CHECK(unrefined <= 1);
}

}  // namespace shaolin
