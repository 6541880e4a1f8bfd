#pragma once
/// The baseline of Mueller et al. 2003, section 9: an object whose box a ray meets is tessellated once, everywhere, at
/// a fixed level; rays meet its flat triangles.
#include <atomic>
#include <mutex>

#include "counters.h"
#include "face_bounds.h"
#include "tessellation.h"
#include "triangle.h"

namespace shaolin {

/// Answers like ShaoLin, with positions on chord triangles: off the limit by O(4^-level), normals interpolated from the
/// limit's, no derivatives.
template <Scheme S>
class Uniform {
 public:
  /// Bounds the object; triangles are made when a ray first meets its box. `level` is 1 or more.
  Uniform(const SchemeSurface<S>& surface, int level) : surface_(surface), level_(level) {
    const SubdivisionMesh<S>& mesh = surface.mesh();
    const std::vector<Box> boxes = face_bounds(mesh);
    for (const int f : mesh.faces()) {
      if (!mesh.has_limit(f)) continue;
      bounds_.add(boxes[static_cast<std::size_t>(f)]);
      limit_faces_ += static_cast<std::uint64_t>(surface.sub_count(f));
    }
  }

  /// The triangle hit with the least t in [tmin, tmax]; of hits at equal distance, the one visited first. Throws what
  /// tessellate() throws.
  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const {
    const TraversalRay traversal(ray);
    const std::optional<Found> found = search(traversal, false, counters);
    return found ? std::optional(hit(*found, traversal, ray)) : std::nullopt;
  }

  /// True if there is a hit in [tmin, tmax].
  bool occluded(const Ray& ray, RayCounters& counters) const {
    return search(TraversalRay(ray), true, counters).has_value();
  }

  const Box& bounds() const { return bounds_; }

  void add_to(Statistics& total) const {
    total.faces += limit_faces_;
    const std::uint64_t bytes = bytes_.load(std::memory_order_relaxed);
    if (bytes > 0) total.faces_touched += limit_faces_;
    total.bytes += bytes;
  }

 private:
  using D = Domain<S::face_kind>;
  using OneFacet = Facet<S::face_kind>;

  /// A facet is one triangle, or two: corners 0 1 2 and 0 2 3.
  static constexpr int triangles_a_facet = D::corner_count - 2;

  struct Triangles {
    Tessellation<S::face_kind> surface;
    Bvh bvh;

    const OneFacet& facet(int triangle) const {
      return surface.facets[static_cast<std::size_t>(triangle / triangles_a_facet)];
    }
    static std::array<std::size_t, 3> places(int triangle) {
      const auto first = static_cast<std::size_t>(1 + triangle % triangles_a_facet);
      return {0, first, first + 1};
    }
    const Vec3& point(int triangle, std::size_t place) const {
      return surface.points[static_cast<std::size_t>(facet(triangle).corners[place])];
    }
  };

  struct Found {
    int triangle;
    TriangleRay::Meeting meeting;
  };

  const Triangles& triangles() const {
    std::call_once(made_, [&] {
      auto made = std::make_unique<Triangles>();
      made->surface = tessellate(surface_.mesh(), level_);
      std::vector<Box> boxes(made->surface.facets.size() * triangles_a_facet);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const int triangle = static_cast<int>(i);
        for (const std::size_t place : Triangles::places(triangle)) boxes[i].add(made->point(triangle, place));
      }
      made->bvh = Bvh(boxes);
      bytes_ = made->bvh.bytes() + made->surface.points.size() * sizeof(Vec3) +
               made->surface.facets.size() * sizeof(OneFacet);
      triangles_ = std::move(made);
    });
    return *triangles_;
  }

  std::optional<Found> search(const TraversalRay& ray, bool any, RayCounters& counters) const {
    if (limit_faces_ == 0 || !entry_distance(bounds_, ray, ray.far)) return {};
    const Triangles& all = triangles();
    const std::optional<BoxRay> box_ray = all.bvh.enter(ray);
    if (!box_ray) return {};
    const TriangleRay triangle_ray(ray);
    std::optional<Found> best;
    double far = ray.far;
    all.bvh.traverse(
        *box_ray, [&] { return box_ray->local(far); },
        [&](int triangle) {
          ++counters.cells;
          const auto [a, b, c] = Triangles::places(triangle);
          const auto meeting =
              triangle_ray.meet(all.point(triangle, a), all.point(triangle, b), all.point(triangle, c), ray.near, far);
          if (!meeting || (best && meeting->distance == far)) return false;
          best = {triangle, *meeting};
          far = meeting->distance;
          return any;
        });
    return best;
  }

  Hit hit(const Found& found, const TraversalRay& traversal, const Ray& ray) const {
    const OneFacet& facet = triangles_->facet(found.triangle);
    Parameter at = Parameter::Zero();
    Hit hit;
    Vec3 normal = Vec3::Zero();
    hit.sample.position.setZero();
    const auto places = Triangles::places(found.triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      const double weight = found.meeting.weights[i];
      at += weight * Parameter(D::corners[places[i]][0], D::corners[places[i]][1]);
      hit.sample.position += weight * triangles_->point(found.triangle, places[i]);
      normal += weight * facet.normals[places[i]];
    }
    at = D::nearest(facet.origin + facet.scale * at);
    hit.t = std::clamp(traversal.t(found.meeting.distance), ray.tmin, ray.tmax);
    hit.at = {facet.face, facet.sub, at.x(), at.y()};
    hit.level = level_;
    hit.sample.normal = normal.isZero(0) ? flat_normal(found.triangle, places) : Vec3(normal.normalized());
    return hit;
  }

  Vec3 flat_normal(int triangle, const std::array<std::size_t, 3>& places) const {
    const Vec3& a = triangles_->point(triangle, places[0]);
    return (triangles_->point(triangle, places[1]) - a).cross(triangles_->point(triangle, places[2]) - a).normalized();
  }

  const SchemeSurface<S>& surface_;
  int level_;
  Box bounds_;
  std::uint64_t limit_faces_ = 0;
  mutable std::once_flag made_;
  mutable std::unique_ptr<Triangles> triangles_;
  mutable std::atomic<std::uint64_t> bytes_{0};  ///< of the triangles, once they are there
};

}  // namespace shaolin
