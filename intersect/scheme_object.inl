#pragma once
/// The definition of make_scheme_object().
#include "a3_finish.h"
#include "chord_finish.h"
#include "disk_proof.h"
#include "exact_finish.h"
#include "scheme_object.h"
#include "shaolin.h"
#include "uniform.h"

namespace shaolin {

namespace detail {

/// The surface and its intersector: ShaoLin or one of the methods that it is compared with.
template <Scheme S, class Intersector>
class SchemeObject final : public Object {
 public:
  /// `more` goes to the intersector, after the surface.
  template <class... More>
  explicit SchemeObject(ControlMesh mesh, const S& scheme, More... more)
      : surface_(std::move(mesh), scheme), intersector_(surface_, more...) {}

  const LimitSurface& surface() const override { return surface_; }
  Box bounds() const override { return intersector_.bounds(); }
  void add_to(Statistics& total) const override { intersector_.add_to(total); }
  std::optional<Hit> intersect(const Ray& ray, RayCounters& counters) const override {
    return intersector_.intersect(ray, counters);
  }
  bool occluded(const Ray& ray, RayCounters& counters) const override { return intersector_.occluded(ray, counters); }
  std::vector<Crossing> all_hits(const Ray& ray, RayCounters& counters) const override {
    if constexpr (requires { intersector_.all_hits(ray, counters); })
      return intersector_.all_hits(ray, counters);
    else
      throw InputError("all hits are those of the limit surface; expected an object of Method::exact");
  }
  Certificate certify(const Ray& ray, const Hit& hit) const override {
    // Methods that find all hits are exact.
    if constexpr (requires(RayCounters & counters) { intersector_.all_hits(ray, counters); }) {
      const TraversalRay traversal(ray);
      if (const auto error = DiskProof<S>(surface_, traversal).error_at(hit.at, hit.sample.position))
        return {Certificate::Status::certified, hit.certificate.residual, *error};
    }
    return hit.certificate;
  }
  std::optional<ClosestPoint> closest_point(const PointQuery& query, RayCounters& counters) const override {
    if constexpr (requires { intersector_.closest_point(query, counters); })
      return intersector_.closest_point(query, counters);
    else
      throw InputError("closest points are asked of the limit surface itself; expected Method::exact");
  }
  std::unique_ptr<SurfaceCell> cells() const override {
    if constexpr (requires { intersector_.cells(); })
      return intersector_.cells();
    else
      throw InputError("shapes are held against the limit surface itself; expected Method::exact");
  }

 private:
  SchemeSurface<S> surface_;
  Intersector intersector_;
};

}  // namespace detail

template <Scheme S>
std::shared_ptr<const Object> make_scheme_object(ControlMesh mesh, const S& scheme, const SceneOptions& options) {
  const auto make = [&]<class Intersector>(const auto&... more) -> std::shared_ptr<const Object> {
    return std::make_shared<detail::SchemeObject<S, Intersector>>(std::move(mesh), scheme, more...);
  };
  switch (options.method) {
    case Method::chord:
      return make.template operator()<ShaoLin<S, ChordFinish>>(ChordFinish<S>(options.chord), options.budget);
    case Method::a3:
      return make.template operator()<ShaoLin<S, A3Finish>>(A3Finish<S>(options.chord), options.budget);
    case Method::uniform:
      return make.template operator()<Uniform<S>>(options.level);
    case Method::exact:
      break;
  }
  return make.template operator()<ShaoLin<S, ExactFinish>>(ExactFinish<S>(), options.budget);
}

}  // namespace shaolin
