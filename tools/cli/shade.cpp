#include "tools/cli/shade.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace shaolin {
namespace {

// Colours are linear. The key is warm and the sky cool, so that lit and shaded parts differ in hue, too.
const Vec3 key_color(1.10, 1.04, 0.94);
const Vec3 sky_color(0.36, 0.42, 0.52);
const Vec3 ground_color(0.20, 0.17, 0.15);
constexpr double gloss = 0.10;
constexpr double gloss_exponent = 48;

/// An arc that turns by a right angle leaves its chord by tan(pi / 8) / 2 of the chord's length: where a surface turns
/// no more within them, two chord faces of one size lie no farther apart than this share of it.
constexpr double bulge = std::numbers::sqrt2 - 1;  // tan(pi / 8)

/// The largest principal curvature, or 0 where derivatives are missing: of the shape operator from both fundamental
/// forms (do Carmo 1976, section 3.3).
double largest_curvature(const LimitSample& sample) {
  if (!sample.derivatives) return 0;
  const Derivatives& d = *sample.derivatives;
  Eigen::Matrix2d first, second;
  first << d.du.squaredNorm(), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.squaredNorm();
  second << sample.normal.dot(d.duu), sample.normal.dot(d.duv), sample.normal.dot(d.duv), sample.normal.dot(d.dvv);
  const Eigen::Matrix2d shape = first.inverse() * second;
  const double mean = 0.5 * shape.trace();
  const double curvature = std::abs(mean) + std::sqrt(std::max(0.0, mean * mean - shape.determinant()));
  return std::isfinite(curvature) ? curvature : 0;
}

}  // namespace

PointLight key_light(const View& view) {
  const double distance = (view.camera().target - view.camera().eye).norm();
  return {view.camera().eye + distance * (0.75 * view.up() - 0.6 * view.right()), key_color};
}

Shader::Seen::Seen(const Ray& ray, const Hit& hit)
    : position(hit.sample.position),
      normal(hit.sample.normal.dot(ray.direction) <= 0 ? hit.sample.normal : Vec3(-hit.sample.normal)),
      facing(-normal.dot(ray.direction) / ray.direction.norm()),
      width(ray.footprint.at(hit.t * ray.direction.norm())),
      curvature(largest_curvature(hit.sample)) {}

Shader::Shader(const Scene& scene, const View& view, Look look, const SceneOptions& options)
    : scene_(scene), look_(std::move(look)), up_(view.up()) {
  if (look_.lights.empty()) look_.lights.push_back(key_light(view));
  const Box bounds = scene.bounds();
  // Far above the rounding of a hit's position, far below what a pixel shows.
  offset_ = 1e-6 * (bounds.upper - bounds.lower).norm();
  if (options.method == Method::chord || options.method == Method::a3) {
    tolerance_ = options.chord.epsilon;
    pixels_ = bulge * options.chord.min_size;
  }
}

/// Both rays meet chord faces, each its own. Where epsilon ends refinement, a face is off the surface by no more than
/// epsilon along the ray that meets it, which is epsilon times the ray's cosine across the surface; where pixels do, by
/// its bulge. So much lies between the two faces across the surface, and along the leaving ray as much over its cosine.
Ray Shader::leaving(const Seen& seen, const Vec3& direction) const {
  constexpr double flattest = 1e-3;  // light that comes flatter adds less than a picture shows
  const double length = direction.norm(), rise = std::max(seen.normal.dot(direction) / length, flattest);
  Ray ray;
  ray.origin = seen.position + offset_ * seen.normal;
  ray.direction = direction;
  ray.tmin = (tolerance_ * (seen.facing + rise) + pixels_ * seen.width) / (rise * length);
  ray.footprint.width = seen.width;
  return ray;
}

bool Shader::lit(const PointLight& light, const Seen& seen) const {
  Ray shadow_ray = leaving(seen, light.position - (seen.position + offset_ * seen.normal));
  shadow_ray.tmax = 1;
  return shadow_ray.tmin >= 1 || !scene_.occluded(shadow_ray);
}

Vec3 Shader::fill(const Vec3& direction) const {
  const double skyward = 0.5 + 0.5 * direction.dot(up_);
  return skyward * sky_color + (1 - skyward) * ground_color;
}

/// A mirror of curvature k turns a ray by 2 k a length: that much more the footprint grows behind it.
Vec3 Shader::reflection(const Ray& ray, const Seen& seen, int reflections_left) const {
  Ray reflected = leaving(seen, (ray.direction - 2 * ray.direction.dot(seen.normal) * seen.normal).normalized());
  reflected.footprint.growth = ray.footprint.growth + 2 * seen.curvature * seen.width;
  if (const std::optional<Hit> hit = scene_.intersect(reflected)) return color(reflected, *hit, reflections_left - 1);
  return look_.background ? *look_.background : fill(reflected.direction);
}

Vec3 Shader::color(const Ray& ray, const Hit& hit, int reflections_left) const {
  const Material& material = look_.material(hit.instance);
  const Seen seen(ray, hit);
  Vec3 color = material.color.cwiseProduct(fill(seen.normal));
  for (const PointLight& light : look_.lights) {
    const Vec3 to_light = (light.position - seen.position).normalized();
    const double incidence = seen.normal.dot(to_light);
    if (incidence > 0 && lit(light, seen)) {
      const Vec3 halfway = (to_light - ray.direction.normalized()).normalized();
      const double highlight = gloss * std::pow(std::max(0.0, seen.normal.dot(halfway)), gloss_exponent);
      color += incidence * light.color.cwiseProduct(material.color) + highlight * light.color;
    }
  }
  if (material.mirror > 0 && reflections_left > 0)
    color += material.mirror * (reflection(ray, seen, reflections_left) - color);
  return color;
}

std::array<float, 3> Shader::shade(const Ray& ray, const Hit& hit) const {
  const Eigen::Vector3f rounded = color(ray, hit, most_reflections).cast<float>();
  return {rounded.x(), rounded.y(), rounded.z()};
}

}  // namespace shaolin
