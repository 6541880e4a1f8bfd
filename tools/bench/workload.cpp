#include "tools/bench/workload.h"

#include <oneapi/tbb/parallel_for.h>

#include "tools/cli/shade.h"

namespace shaolin {
namespace {

constexpr double shadow_offset = 4;  ///< pixels; see make_workload()

/// Appends the shadow rays of one hit.
void add_shadow_rays(const Ray& ray, const Hit& hit, const std::vector<PointLight>& lights, std::vector<Ray>& rays) {
  const bool front = hit.sample.normal.dot(ray.direction) <= 0;
  const Vec3 normal = front ? hit.sample.normal : Vec3(-hit.sample.normal);
  const double width = ray.footprint.at(hit.t);
  for (const PointLight& light : lights) {
    if (normal.dot(light.position - hit.sample.position) <= 0) continue;
    Ray shadow;
    shadow.origin = hit.sample.position + shadow_offset * width * normal;
    shadow.direction = light.position - shadow.origin;
    shadow.tmax = 1;
    shadow.footprint.width = width;
    rays.push_back(shadow);
  }
}

}  // namespace

Workload make_workload(const Scene& exact, const View& view, const Look& look) {
  const std::vector<PointLight> lights = look.lights.empty() ? std::vector{key_light(view)} : look.lights;
  const ImageSize size = view.size();
  Workload work;
  work.primary.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  std::vector<std::vector<Ray>> shadows(static_cast<std::size_t>(size.height));  // by row
  tbb::parallel_for(0, size.height, [&](int y) {
    for (int x = 0; x < size.width; ++x) {
      const Ray ray = view.ray(x, y);
      work.primary[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x)] =
          ray;
      if (const auto hit = exact.intersect(ray))
        add_shadow_rays(ray, *hit, lights, shadows[static_cast<std::size_t>(y)]);
    }
  });
  for (const auto& row : shadows) work.shadow.insert(work.shadow.end(), row.begin(), row.end());
  return work;
}

}  // namespace shaolin
