#pragma once
/// The definition of make_scheme_scene().
#include <tbb/enumerable_thread_specific.h>

#include "scheme_scene.h"
#include "shaolin.h"
#include "uniform.h"

namespace shaolin {

namespace detail {

inline void check(const Ray& ray) {
  const auto text = [](const Vec3& v) {
    return "(" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) + ")";
  };
  if (!ray.origin.allFinite()) throw InputError("ray origin " + text(ray.origin) + " is not finite");
  if (!ray.direction.allFinite()) throw InputError("ray direction " + text(ray.direction) + " is not finite");
  if (ray.direction.isZero(0)) throw InputError("ray direction is zero; expected a direction of any other length");
  if (std::isnan(ray.tmin) || std::isnan(ray.tmax)) throw InputError("ray interval [tmin, tmax] has a NaN");
}

/// `Intersector` is ShaoLin or one of the methods that it is compared with.
template <Scheme S, class Intersector>
class SchemeScene final : public Scene::Implementation {
 public:
  /// `more` goes to the intersector, after the surface.
  template <class... More>
  explicit SchemeScene(ControlMesh mesh, const S& scheme, More... more)
      : surface_(std::move(mesh), scheme), intersector_(surface_, more...) {}

  std::optional<Hit> intersect(const Ray& ray) const override {
    return counted(ray, [&](RayCounters& counters) { return intersector_.intersect(ray, counters); });
  }
  bool occluded(const Ray& ray) const override {
    return counted(ray, [&](RayCounters& counters) { return intersector_.occluded(ray, counters); });
  }
  const LimitSurface& surface() const override { return surface_; }
  Box bounds() const override { return intersector_.bounds(); }

  Statistics statistics() const override {
    Statistics total;
    for (const Statistics& local : counters_) {
      total.rays += local.rays;
      total.hits += local.hits;
      total.hull_tests += local.hull_tests;
      total.cells += local.cells;
      total.newton_steps += local.newton_steps;
    }
    intersector_.add_to(total);
    return total;
  }

 private:
  template <class Query>
  auto counted(const Ray& ray, Query query) const {
    check(ray);
    RayCounters counters;
    const auto answer = query(counters);
    Statistics& local = own_counters();
    counters.add_to(local);
    ++local.rays;
    local.hits += static_cast<bool>(answer);
    return answer;
  }

  /// This thread's counters. A thread asks one scene many times in a row, so it remembers its last answer: looking them
  /// up is a twentieth of a ray that misses.
  Statistics& own_counters() const {
    thread_local std::uint64_t last_scene = 0;
    thread_local Statistics* last = nullptr;
    if (last_scene != serial_) {
      last = &counters_.local();
      last_scene = serial_;
    }
    return *last;
  }

  /// A number that no other scene of this type ever has; 0 is none's.
  static std::uint64_t next_serial() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
  }

  SchemeSurface<S> surface_;
  Intersector intersector_;
  std::uint64_t serial_ = next_serial();
  mutable tbb::enumerable_thread_specific<Statistics> counters_;
};

}  // namespace detail

template <Scheme S>
std::unique_ptr<Scene::Implementation> make_scheme_scene(ControlMesh mesh, const S& scheme, const SceneOptions& options) {
  if (options.method == Method::uniform)
    return std::make_unique<detail::SchemeScene<S, Uniform<S>>>(std::move(mesh), scheme, options.level);
  return std::make_unique<detail::SchemeScene<S, ShaoLin<S, ExactFinish>>>(std::move(mesh), scheme);
}

}  // namespace shaolin
