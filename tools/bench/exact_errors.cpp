#include "tools/bench/exact_errors.h"

#include <algorithm>
#include <memory>

#include "tools/validate/quad_oracle.h"

namespace shaolin {
namespace {

double to_double(const Quad& length) { return static_cast<double>(length); }

/// The hits of every n-th ray that hits.
std::vector<std::pair<Ray, Hit>> sample_hits(const Scene& exact, std::span<const Ray> rays, std::size_t count) {
  std::vector<std::size_t> hitting;
  const Answers answers = trace(rays, exact);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (answers[i]) hitting.push_back(i);
  std::vector<std::pair<Ray, Hit>> hits;
  count = std::min(count, hitting.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Ray& ray = rays[hitting[i * hitting.size() / count]];
    hits.emplace_back(ray, *exact.intersect(ray));
  }
  return hits;
}

}  // namespace

ExactErrors exact_errors(const Stage& stage, const Scene& exact, std::span<const Ray> rays, std::size_t count) {
  for (const LoadedModel& model : stage.models)
    if (model.masks) return {};
  std::vector<std::unique_ptr<const QuadOracle>> oracles(stage.models.size());
  std::vector<double> position, across, along;
  for (const auto& [ray, hit] : sample_hits(exact, rays, count)) {
    const SceneFile::Instance& instance = stage.scene.instances[static_cast<std::size_t>(hit.instance)];
    std::unique_ptr<const QuadOracle>& oracle = oracles[instance.object];
    if (!oracle) {
      const LoadedModel& model = stage.models[instance.object];
      oracle = std::make_unique<QuadOracle>(model.mesh, model.scheme);
    }
    const Eigen::Matrix<Quad, 3, 3> linear = instance.transform.linear().cast<Quad>();
    const Vec3 shift = instance.transform.translation();
    const QuadVec3 point = linear * oracle->position(hit.at) + shift.cast<Quad>();
    const QuadVec3 origin = ray.origin.cast<Quad>(), direction = ray.direction.cast<Quad>();
    const Quad t = (point - origin).dot(direction) / direction.squaredNorm();
    position.push_back(to_double((hit.sample.position.cast<Quad>() - point).norm()));
    across.push_back(to_double((origin + t * direction - point).norm()));
    along.push_back(to_double(abs(t - Quad(hit.t)) * direction.norm()));
  }
  return {position.size(), quantiles(position), quantiles(across), quantiles(along)};
}

}  // namespace shaolin
