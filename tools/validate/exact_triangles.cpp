#include "tools/validate/exact_triangles.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "intersect/box.h"
#include "intersect/tessellation.h"
#include "schemes/builtin.h"

namespace shaolin {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Vector = Kernel::Vector_3;
using Point = Kernel::Point_3;

Point exact_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

/// What exact arithmetic says of one ray: the least t at which a triangle is met, and whether any is.
struct ExactRay {
  std::optional<double> t;
};

class TriangleCheck {
 public:
  explicit TriangleCheck(const TriangleSoup& soup) : soup_(soup) {
    for (const auto& triangle : soup.triangles) {
      Box box;
      for (const int v : triangle) box.add(point(v));
      boxes_.push_back(box.with_rounding());
      all_.add(box);
      for (std::size_t i = 0; i < 3; ++i)
        sides_[std::minmax(triangle[i], triangle[(i + 1) % 3])].push_back(boxes_.size() - 1);
    }
  }

  void ray(const Intersector& ours, const Ray& ray);

  ExactTriangleFigures figures;

 private:
  const Vec3& point(int v) const { return soup_.points[static_cast<std::size_t>(v)]; }
  const Vec3& corner(std::size_t triangle, std::size_t i) const { return point(soup_.triangles[triangle][i]); }

  std::optional<Number> meet(std::size_t triangle, const Point& origin, const Vector& direction) const;
  ExactRay decide(const Ray& ray);
  bool is_excused(const Ray& ray) const;

  const TriangleSoup& soup_;
  std::vector<Box> boxes_;
  Box all_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> sides_;  ///< and the triangles there
};

/// The exact t, if the ray's line goes through the triangle, its rim included. One that holds the line, or without
/// area, is not met: its neighbours are.
std::optional<Number> TriangleCheck::meet(std::size_t triangle, const Point& origin, const Vector& direction) const {
  const std::array<Vector, 3> p{exact_point(corner(triangle, 0)) - origin, exact_point(corner(triangle, 1)) - origin,
                                exact_point(corner(triangle, 2)) - origin};
  std::array<CGAL::Sign, 3> side{};
  for (std::size_t i = 0; i < 3; ++i) side[i] = CGAL::sign(CGAL::cross_product(p[i], p[(i + 1) % 3]) * direction);
  const auto has = [&](CGAL::Sign sign) { return std::find(side.begin(), side.end(), sign) != side.end(); };
  if (has(CGAL::POSITIVE) == has(CGAL::NEGATIVE)) return {};  // both, or all zero
  const Vector normal = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
  const Number slope = normal * direction;
  if (CGAL::is_zero(slope)) return {};
  return (normal * p[0]) / slope;
}

ExactRay TriangleCheck::decide(const Ray& ray) {
  const TraversalRay traversal(ray);
  const Point origin = exact_point(ray.origin);
  const Vector direction(ray.direction.x(), ray.direction.y(), ray.direction.z());
  ExactRay result;
  std::optional<Number> nearest;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!entry_distance(boxes_[i], traversal, traversal.far)) continue;
    ++figures.decisions;
    const std::optional<Number> t = meet(i, origin, direction);
    if (!t || *t < ray.tmin || (std::isfinite(ray.tmax) && *t > ray.tmax)) continue;
    if (!nearest || *t < *nearest) nearest = t;
  }
  if (nearest) result.t = CGAL::to_double(*nearest);
  return result;
}

/// True if the ray passes an outline or a boundary within rounding: 64 u of the largest coordinate relative to its
/// origin, some times what the differences and products of TriangleRay round.
bool TriangleCheck::is_excused(const Ray& ray) const {
  const Vec3 d = ray.direction.normalized();
  return std::any_of(sides_.begin(), sides_.end(), [&](const auto& side) {
    const auto& [ends, triangles] = side;
    const Vec3 a = point(ends.first) - ray.origin, b = point(ends.second) - ray.origin;
    const Vec3 flat_a = a - a.dot(d) * d, along = (b - a) - (b - a).dot(d) * d;
    const double share = along.isZero(0) ? 0 : std::clamp(-flat_a.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double reach = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    if ((flat_a + share * along).norm() > 64 * unit_roundoff * reach) return false;
    if (triangles.size() != 2) return true;
    const auto facing = [&](std::size_t t) {
      const Vec3 normal = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
      return normal.dot(d) > 0;
    };
    return facing(triangles[0]) != facing(triangles[1]);
  });
}

void TriangleCheck::ray(const Intersector& ours, const Ray& ray) {
  ++figures.rays;
  const ExactRay exact_ray = decide(ray);
  const std::optional<Hit> hit = ours.intersect(ray);
  figures.hits += exact_ray.t.has_value();
  if (!hit && !exact_ray.t) return;
  const double none = std::numeric_limits<double>::infinity();
  const double t = exact_ray.t.value_or(none), our_t = hit ? hit->t : none;
  const double reach = std::min(std::abs(t), std::abs(our_t)) * ray.direction.norm() + (all_.upper - all_.lower).norm();
  const double error = std::abs(t - our_t) * ray.direction.norm() / reach;
  if (error <= bar::on_ray) {
    figures.worst_t = std::max(figures.worst_t, error);
    return;
  }
  if (is_excused(ray)) {
    ++figures.excused;
    return;
  }
  figures.disagreements.push_back(
      {our_t > t ? "lost triangle" : "ghost triangle",
       {},
       ray,
       "exact t " + (exact_ray.t ? exact(t) : "none") + ", ours " + (hit ? exact(our_t) : "none"),
       error,
       bar::on_ray});
}

}  // namespace

TriangleSoup uniform_triangles(const ControlMesh& mesh, const std::string& scheme, int level) {
  if (scheme != "loop" && scheme != "catmark") return {};
  TriangleSoup soup;
  with_scheme(scheme, [&](const auto& masks) {
    using S = std::decay_t<decltype(masks)>;
    const auto tessellation = tessellate(SubdivisionMesh<S>(mesh, masks), level);
    soup.points = tessellation.points;
    for (const auto& facet : tessellation.facets)
      for (std::size_t last = 2; last < facet.corners.size(); ++last)
        soup.triangles.push_back({facet.corners[0], facet.corners[last - 1], facet.corners[last]});
  });
  return soup;
}

ExactTriangleFigures check_exact_triangles(const Intersector& ours, const TriangleSoup& soup,
                                           std::span<const ProbeRay> rays) {
  TriangleCheck check(soup);
  for (const ProbeRay& probe : rays) check.ray(ours, probe.ray);
  return check.figures;
}

}  // namespace shaolin
