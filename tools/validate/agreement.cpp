#include "tools/validate/agreement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace shaolin {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double ratio(double part, double whole) {
  if (part == 0) return 0;
  const double quotient = part / whole;
  return std::isnan(quotient) ? infinite : quotient;
}

bool is_unit(const Vec3& v) { return std::abs(v.norm() - 1) <= 1e-9; }

}  // namespace

ErrorSummary summarize(std::span<const double> errors) {
  ErrorSummary summary;
  if (errors.empty()) return summary;
  std::vector<double> sorted(errors.begin(), errors.end());
  for (double& error : sorted) error = std::isnan(error) ? infinite : error;
  summary.count = sorted.size();
  summary.worst = static_cast<std::size_t>(std::max_element(sorted.begin(), sorted.end()) - sorted.begin());
  summary.max = sorted[summary.worst];
  const auto rank = [&](std::size_t percent) {
    const auto at = sorted.begin() + static_cast<std::ptrdiff_t>((percent * sorted.size() + 99) / 100 - 1);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
  };
  summary.median = rank(50);
  summary.p99 = rank(99);
  return summary;
}

double angle_between_units(const Vec3& a, const Vec3& b) {
  if (!is_unit(a) || !is_unit(b)) return infinite;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double derivative_error(const Derivatives& ours, const Derivatives& theirs, double corner_distance) {
  const double first = std::max(theirs.du.norm(), theirs.dv.norm());
  const double second = std::max({theirs.duu.norm(), theirs.duv.norm(), theirs.dvv.norm()}) + first / corner_distance;
  const double first_error = std::max((ours.du - theirs.du).norm(), (ours.dv - theirs.dv).norm());
  const double second_error =
      std::max({(ours.duu - theirs.duu).norm(), (ours.duv - theirs.duv).norm(), (ours.dvv - theirs.dvv).norm()});
  return std::max(ratio(first_error, first), ratio(second_error, second));
}

double normal_uncertainty(const Derivatives& derivatives) {
  // A derivative of a bicubic or quartic piece adds up 16 or 15 weighted points.
  constexpr double roundings = 16 * 0x1p-53;
  const double longer = std::max(derivatives.du.norm(), derivatives.dv.norm());
  const double area = derivatives.du.cross(derivatives.dv).norm();
  if (!(area > 0)) return infinite;
  return roundings * longer * (derivatives.du.norm() + derivatives.dv.norm()) / area;
}

double normal_uncertainty(const LimitSample& sample) {
  if (!is_unit(sample.normal)) return infinite;
  return sample.derivatives ? normal_uncertainty(*sample.derivatives) : 0;
}

bool has_determined_normal(const LimitSample& sample) { return normal_uncertainty(sample) <= bar::normal; }

std::string exact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string exact(const Vec3& vector) { return exact(vector.x()) + ',' + exact(vector.y()) + ',' + exact(vector.z()); }

std::string exact(const SurfaceParameter& at) {
  return std::to_string(at.face) + ',' + std::to_string(at.sub) + ',' + exact(at.u) + ',' + exact(at.v);
}

std::string exact(const Ray& ray) {
  return exact(ray.origin) + ',' + exact(ray.direction) + ',' + exact(ray.tmin) + ',' + exact(ray.tmax);
}

}  // namespace shaolin
