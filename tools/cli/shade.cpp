#include "tools/cli/shade.h"

#include <cmath>
#include <utility>

namespace shaolin {
namespace {

// Colours are linear. The key is warm and the sky cool, so that lit and shaded parts differ in hue, too.
const Vec3 key_color(1.10, 1.04, 0.94);
const Vec3 sky_color(0.36, 0.42, 0.52);
const Vec3 ground_color(0.20, 0.17, 0.15);
constexpr double gloss = 0.10;
constexpr double gloss_exponent = 48;

}  // namespace

PointLight key_light(const View& view) {
  const double distance = (view.camera().target - view.camera().eye).norm();
  return {view.camera().eye + distance * (0.75 * view.up() - 0.6 * view.right()), key_color};
}

Shader::Shader(const Scene& scene, const View& view, Look look)
    : scene_(scene), look_(std::move(look)), up_(view.up()) {
  if (look_.lights.empty()) look_.lights.push_back(key_light(view));
  const Box bounds = scene.bounds();
  // Far above the rounding of a hit's position, far below what a pixel shows.
  offset_ = 1e-6 * (bounds.upper - bounds.lower).norm();
}

bool Shader::lit(const PointLight& light, const Vec3& position, const Vec3& normal) const {
  Ray shadow_ray;
  shadow_ray.origin = position + offset_ * normal;
  shadow_ray.direction = light.position - shadow_ray.origin;
  shadow_ray.tmax = 1;
  return !scene_.occluded(shadow_ray);
}

Vec3 Shader::fill(const Vec3& direction) const {
  const double skyward = 0.5 + 0.5 * direction.dot(up_);
  return skyward * sky_color + (1 - skyward) * ground_color;
}

Vec3 Shader::reflection(const Ray& ray, const Vec3& position, const Vec3& normal, int reflections_left) const {
  Ray reflected;
  reflected.origin = position + offset_ * normal;
  reflected.direction = (ray.direction - 2 * ray.direction.dot(normal) * normal).normalized();
  if (const std::optional<Hit> hit = scene_.intersect(reflected)) return color(reflected, *hit, reflections_left - 1);
  return look_.background ? *look_.background : fill(reflected.direction);
}

Vec3 Shader::color(const Ray& ray, const Hit& hit, int reflections_left) const {
  const Material& material = look_.material(hit.instance);
  const Vec3& position = hit.sample.position;
  const bool front = hit.sample.normal.dot(ray.direction) <= 0;
  const Vec3 normal = front ? hit.sample.normal : Vec3(-hit.sample.normal);

  Vec3 color = material.color.cwiseProduct(fill(normal));
  for (const PointLight& light : look_.lights) {
    const Vec3 to_light = (light.position - position).normalized();
    const double incidence = normal.dot(to_light);
    if (incidence > 0 && lit(light, position, normal)) {
      const Vec3 halfway = (to_light - ray.direction.normalized()).normalized();
      const double highlight = gloss * std::pow(std::max(0.0, normal.dot(halfway)), gloss_exponent);
      color += incidence * light.color.cwiseProduct(material.color) + highlight * light.color;
    }
  }
  if (material.mirror > 0 && reflections_left > 0)
    color += material.mirror * (reflection(ray, position, normal, reflections_left) - color);
  return color;
}

std::array<float, 3> Shader::shade(const Ray& ray, const Hit& hit) const {
  const Eigen::Vector3f rounded = color(ray, hit, most_reflections).cast<float>();
  return {rounded.x(), rounded.y(), rounded.z()};
}

}  // namespace shaolin
