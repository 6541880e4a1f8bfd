#pragma once
/// How far two parties are apart, and how far they may be.
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "intersect/ray.h"
#include "schemes/limit_sample.h"

namespace shaolin {

/// The bars that agreement is held to. Lengths are in diagonals of the control mesh's bounding box.
namespace bar {
inline constexpr double position_median = 1e-14;  ///< tens of roundings
inline constexpr double position_p99 = 1e-12;
inline constexpr double position_max = 1e-10;
inline constexpr double normal = 1e-7;      ///< radians
inline constexpr double derivative = 1e-7;  ///< relative, see derivative_error()
inline constexpr double on_ray = 1e-12;     ///< of |t| |d| + diagonal
inline constexpr double on_surface = 1e-9;
}  // namespace bar

/// Order statistics of errors. All are 0 if there are none; the 99th percentile is the nearest rank.
struct ErrorSummary {
  std::size_t count = 0;
  double median = 0, p99 = 0, max = 0;
  std::size_t worst = 0;  ///< the index of max
};

/// A NaN counts as infinite: nothing agrees with it. O(n).
ErrorSummary summarize(std::span<const double> errors);

/// In [0, pi]; infinite if either is not a finite vector of length 1 to 1e-9.
double angle_between_units(const Vec3& a, const Vec3& b);

/// The larger of the errors of first and of second derivatives. First ones are relative to the longer of du and dv,
/// second ones to the longest of the three plus that of the first over the distance from the nearest corner: a piece
/// at a distance of 2^-k has 2^-k of the face's size, and second differences of its points carry the roundings of
/// first ones times 2^k.
double derivative_error(const Derivatives& ours, const Derivatives& theirs, double corner_distance);

/// The angle by which rounding may turn the normal of du and dv: (|e| |dv| + |du| |e|) / |du x dv| where each of du and
/// dv is a sum of differences of points and carries an error e of some roundings of the longer one. Infinite where they
/// are parallel or zero, as at collapsed sides of patches; there double precision determines no normal.
double normal_uncertainty(const Derivatives& derivatives);

/// The same for a sample of the oracle, which has a zero normal where the surface has no tangent plane. At irregular
/// corners, where masks give the normal, it is zero.
double normal_uncertainty(const LimitSample& sample);

/// True if the oracle's normal binds us to bar::normal.
bool has_determined_normal(const LimitSample& sample);

/// One case in which the parties differ.
struct Disagreement {
  std::string what;                    ///< "lost hit", "position", ...
  std::optional<SurfaceParameter> at;  ///< a row for `shaolin eval`
  std::optional<Ray> ray;              ///< a row for `shaolin query`
  std::string detail;                  ///< both values
  double error = 0, allowed = 0;
};

/// 17 significant digits, as the tool's tables have them.
std::string exact(double value);
std::string exact(const Vec3& vector);
std::string exact(const SurfaceParameter& at);  ///< face,sub,u,v
std::string exact(const Ray& ray);              ///< ox,oy,oz,dx,dy,dz,tmin,tmax

}  // namespace shaolin
