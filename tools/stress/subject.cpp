#include "tools/stress/subject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "intersect/inside.h"
#include "schemes/errors.h"

namespace shaolin::stress {

namespace {

std::shared_ptr<const Object> object_of(const StressModel& model) {
  return model.masks ? make_object(model.mesh, model.masks) : make_object(model.mesh, model.scheme);
}

bool is_closed_surface(const LimitSurface& surface) {
  try {
    expect_closed(surface);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

/// By the norms of rows; within 3 of the spectral one.
double norm_of(const Eigen::Matrix3d& matrix) { return matrix.cwiseAbs().rowwise().sum().maxCoeff(); }

}  // namespace

RayQueries RayQueries::of(const Scene& scene) {
  return {[&](const Ray& ray) { return scene.intersect(ray); }, [&](const Ray& ray) { return scene.occluded(ray); },
          [&](const Ray& ray) { return scene.all_hits(ray); },
          [&](const Ray& ray, const Hit& hit) { return scene.certify(ray, hit); }};
}

Subject::Subject(const StressModel& model, const QueriesOf& queries_of, std::string variant, const Affine& map)
    : name_(model.name),
      variant_(std::move(variant)),
      map_(map),
      scene_(std::make_unique<const Scene>(std::vector<Instance>{{object_of(model), map}})),
      queries_(queries_of(*scene_)),
      sites_(scene_->surface()),
      control_box_(scene_->bounds()),
      normals_(map.linear().inverse().transpose()),
      is_identity_(map.matrix() == Affine::Identity().matrix()),
      is_closed_(is_closed_surface(scene_->surface())) {
  patches_.resize(static_cast<std::size_t>(surface().face_count()));
  for (const auto& [face, sub] : sites_.pieces)
    patches_[static_cast<std::size_t>(face)].push_back(surface().limit_patch(face, sub));
  for (const auto& [face, sub] : sites_.pieces)
    for (const auto& [u, v] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {0.3125, 0.3125}})
      box_.add(evaluate({face, sub, u, v}).position);
  const double size = sites_.pieces.empty() ? 0 : (box_.upper - box_.lower).stableNorm();
  diagonal_ = size > 0 ? size : std::max(box_.largest_coordinate() * 0x1p-20, std::numeric_limits<double>::min());
  if (!is_identity_) {
    condition_ = norm_of(map.linear()) * norm_of(map.linear().inverse());
    object_size_ = norm_of(map.linear()) * scene_->instances().front().object->bounds().largest_coordinate();
  }
}

double Subject::distance(const Vec3& point) const {
  const std::optional<ClosestPoint> closest = scene_->closest_point(point);
  return closest ? closest->distance : std::numeric_limits<double>::infinity();
}

LimitSample Subject::evaluate(const SurfaceParameter& at) const {
  LimitSample sample =
      patches_[static_cast<std::size_t>(at.face)][static_cast<std::size_t>(at.sub)]->evaluate(at.u, at.v);
  if (is_identity_) return sample;
  sample.position = map_ * sample.position;
  sample.normal = (normals_ * sample.normal).stableNormalized();
  if (sample.derivatives)
    for (Vec3* derivative : {&sample.derivatives->du, &sample.derivatives->dv, &sample.derivatives->duu,
                             &sample.derivatives->duv, &sample.derivatives->dvv})
      *derivative = map_.linear() * *derivative;
  return sample;
}

double Subject::rounding(const Ray& ray) const {
  const double relative = std::max((control_box_.lower - ray.origin).cwiseAbs().maxCoeff(),
                                   (control_box_.upper - ray.origin).cwiseAbs().maxCoeff());
  const double largest = std::max(control_box_.largest_coordinate(), object_size_);
  return unit_roundoff * (160 * largest + 64 * relative) * condition_;
}

double Subject::grazing(const Ray& ray) const {
  constexpr double least = 1e-4;
  return std::max(least, 16 * std::sqrt(rounding(ray) / diagonal_));
}

double Subject::magnitude(const Ray& ray) const {
  return std::max({control_box_.largest_coordinate(), ray.origin.cwiseAbs().maxCoeff()});
}

}  // namespace shaolin::stress
