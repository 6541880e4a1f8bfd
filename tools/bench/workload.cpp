#include "tools/bench/workload.h"

#include <oneapi/tbb/parallel_for.h>

#include <cstdint>

#include "tools/cli/shade.h"
#include "tools/validate/random.h"

namespace shaolin {
namespace {

constexpr double shadow_offset = 4;          ///< pixels; see make_workload()
constexpr double ambient_length = 1.0 / 20;  ///< diagonals
constexpr std::uint64_t seed = 2003;         ///< any would do

/// The side of a surface that a ray sees, and where rays from there start.
struct SeenSide {
  Vec3 normal, origin;
  double width;  ///< of the pixel

  SeenSide(const Ray& ray, const Hit& hit) : width(ray.footprint.at(hit.t)) {
    const bool front = hit.sample.normal.dot(ray.direction) <= 0;
    normal = front ? hit.sample.normal : Vec3(-hit.sample.normal);
    origin = hit.sample.position + shadow_offset * width * normal;
  }
};

/// Appends the shadow rays of one hit.
void add_shadow_rays(const Ray& ray, const Hit& hit, const std::vector<PointLight>& lights, std::vector<Ray>& rays) {
  const SeenSide side(ray, hit);
  for (const PointLight& light : lights) {
    if (side.normal.dot(light.position - hit.sample.position) <= 0) continue;
    Ray shadow;
    shadow.origin = side.origin;
    shadow.direction = light.position - shadow.origin;
    shadow.tmax = 1;
    shadow.footprint.width = side.width;
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

void add_random_and_ambient_rays(const Scene& exact, Workload& work) {
  const Box box = exact.bounds();
  const double diagonal = (box.upper - box.lower).norm();
  SampleRandom random(seed);
  for (const Ray& primary : work.primary) {
    Ray ray;
    ray.origin = box.centre() + diagonal * random.direction();
    ray.direction = (random.inside(box.lower, box.upper) - ray.origin).normalized();
    ray.footprint = primary.footprint;
    work.random.push_back(ray);
  }
  for (const Ray& primary : work.primary) {
    const auto hit = exact.intersect(primary);
    if (!hit) continue;
    const SeenSide side(primary, *hit);
    Ray ray;
    ray.origin = side.origin;
    // A unit normal and a unit vector that is uniform on the sphere add up to a direction by the cosine.
    ray.direction = (side.normal + random.direction()).normalized();
    ray.tmax = ambient_length * diagonal;
    ray.footprint.width = side.width;
    work.ambient.push_back(ray);
  }
}

}  // namespace shaolin
