#include "tools/cli/shade.h"

#include <cmath>

namespace shaolin {
namespace {

// Colours are linear. The key is warm and the sky cool, so that lit and shaded parts differ in hue, too.
const Vec3 albedo(0.62, 0.56, 0.50);
const Vec3 key_color(1.10, 1.04, 0.94);
const Vec3 sky_color(0.36, 0.42, 0.52);
const Vec3 ground_color(0.20, 0.17, 0.15);
constexpr double gloss = 0.10;
constexpr double gloss_exponent = 48;

}  // namespace

Shader::Shader(const Scene& scene, const View& view) : scene_(scene), up_(view.up()) {
  const double distance = (view.camera().target - view.camera().eye).norm();
  light_ = view.camera().eye + distance * (0.75 * view.up() - 0.6 * view.right());
  const Box bounds = scene.bounds();
  // Far above the rounding of a hit's position, far below what a pixel shows.
  shadow_offset_ = 1e-6 * (bounds.upper - bounds.lower).norm();
}

bool Shader::lit(const Vec3& position, const Vec3& normal) const {
  Ray shadow_ray;
  shadow_ray.origin = position + shadow_offset_ * normal;
  shadow_ray.direction = light_ - shadow_ray.origin;
  shadow_ray.tmax = 1;
  return !scene_.occluded(shadow_ray);
}

std::array<float, 3> Shader::shade(const Ray& ray, const Hit& hit) const {
  const Vec3& position = hit.sample.position;
  const bool front = hit.sample.normal.dot(ray.direction) <= 0;
  const Vec3 normal = front ? hit.sample.normal : Vec3(-hit.sample.normal);

  const double skyward = 0.5 + 0.5 * normal.dot(up_);
  const Vec3 fill = skyward * sky_color + (1 - skyward) * ground_color;
  Vec3 color = albedo.cwiseProduct(fill);

  const Vec3 to_light = (light_ - position).normalized();
  const double incidence = normal.dot(to_light);
  if (incidence > 0 && lit(position, normal)) {
    const Vec3 halfway = (to_light - ray.direction.normalized()).normalized();
    const double highlight = gloss * std::pow(std::max(0.0, normal.dot(halfway)), gloss_exponent);
    color += incidence * key_color.cwiseProduct(albedo) + highlight * key_color;
  }
  const Eigen::Vector3f rounded = color.cast<float>();
  return {rounded.x(), rounded.y(), rounded.z()};
}

}  // namespace shaolin
