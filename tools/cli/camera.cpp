#include "tools/cli/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "schemes/text.h"
#include "tools/cli/number_list.h"

namespace shaolin {
namespace {

constexpr int max_image_side = 32768;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// The image's up direction before it is made perpendicular to the view.
Vec3 up_hint(const Vec3& forward, const Vec3& up) {
  constexpr double parallel = 1e-6;  // sine of the angle below which `up` says nothing about the image's roll
  if (forward.cross(up).norm() > parallel) return up;
  const Vec3 other = std::abs(up.z()) > 0.9 ? Vec3::UnitY() : Vec3::UnitZ();
  return forward.dot(up) < 0 ? Vec3(-other) : other;
}

}  // namespace

ImageSize parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto side = [](std::string_view word) { return to_integer(word).value_or(0); };
  const long long width = cross == std::string::npos ? 0 : side(std::string_view(text).substr(0, cross));
  const long long height = cross == std::string::npos ? 0 : side(std::string_view(text).substr(cross + 1));
  if (std::min(width, height) < 1 || std::max(width, height) > max_image_side)
    throw std::invalid_argument("'" + text + "' is not WxH with sides from 1 to " + std::to_string(max_image_side));
  return {static_cast<int>(width), static_cast<int>(height)};
}

std::string fault_of(const Camera& camera) {
  const double distance = (camera.target - camera.eye).stableNorm();
  if (!(distance > 0) || !std::isfinite(distance))
    return "the target must lie apart from the eye, at a finite distance";
  if (!(camera.fov > 0 && camera.fov < 180)) return "fov, the vertical angle in degrees, must lie between 0 and 180";
  if (!camera.up.allFinite() || camera.up.isZero(0)) return "up must be a finite vector of any length but zero";
  return {};
}

Camera parse_camera(const std::string& text) {
  Camera camera;
  const auto set = [&camera](const auto& numbers) {
    camera.eye = {numbers[0], numbers[1], numbers[2]};
    camera.target = {numbers[3], numbers[4], numbers[5]};
    camera.fov = numbers[6];
  };
  if (const auto seven = parse_list<7>(text)) {
    set(*seven);
  } else if (const auto ten = parse_list<10>(text)) {
    set(*ten);
    camera.up = {(*ten)[7], (*ten)[8], (*ten)[9]};
  } else {
    throw std::invalid_argument("'" + text + "' is not ex,ey,ez,tx,ty,tz,fov[,ux,uy,uz]: seven or ten finite numbers");
  }
  if (const std::string fault = fault_of(camera); !fault.empty())
    throw std::invalid_argument("'" + text + "': " + fault);
  return camera;
}

std::string to_string(const Camera& camera) {
  std::string text;
  const auto append = [&text](double number) {
    std::array<char, 32> digits;
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), result.ptr);
  };
  for (const Vec3& point : {camera.eye, camera.target})
    for (int axis = 0; axis < 3; ++axis) {
      append(point[axis]);
      text += ',';
    }
  append(camera.fov);
  if (camera.up != Vec3::UnitY())
    for (int axis = 0; axis < 3; ++axis) {
      text += ',';
      append(camera.up[axis]);
    }
  return text;
}

Camera default_camera(const Box& bounds, ImageSize size) {
  Camera camera;
  camera.target = 0.5 * (bounds.lower + bounds.upper);
  const double radius = 0.5 * (bounds.upper - bounds.lower).norm();
  const double half_height = std::tan(0.5 * radians(camera.fov));
  const double half_angle = std::atan(half_height * std::min(1.0, size.aspect()));
  const double distance = (radius > 0 ? radius : 1) / std::sin(half_angle);
  camera.eye = camera.target + distance * Vec3(0.55, 0.45, 1).normalized();
  return camera;
}

View::View(const Camera& camera, ImageSize size)
    : camera_(camera), size_(size), half_height_(std::tan(0.5 * radians(camera.fov))) {
  forward_ = (camera.target - camera.eye).stableNormalized();
  right_ = forward_.cross(up_hint(forward_, camera.up.stableNormalized())).normalized();
  up_ = right_.cross(forward_);
}

Vec3 View::direction(double x, double y) const {
  const double across = 2 * x / size_.width - 1;
  const double upward = 1 - 2 * y / size_.height;
  return forward_ + half_height_ * (across * size_.aspect() * right_ + upward * up_);
}

Ray View::ray(int x, int y) const {
  Ray ray;
  ray.origin = camera_.eye;
  ray.direction = direction(x + 0.5, y + 0.5).normalized();
  ray.footprint.growth = 2 * half_height_ / size_.height;
  return ray;
}

}  // namespace shaolin
