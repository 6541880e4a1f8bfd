#pragma once
/// An independent look for hits that the intersector misses: a tessellation of the oracle's surface, each candidate
/// polished on the surface itself.
#include <memory>
#include <optional>

#include "tools/validate/oracle.h"

namespace shaolin {

/// A point of the oracle's surface on a ray; t in units of the direction's length.
struct OracleHit {
  double t;
  SurfaceParameter at;
  LimitSample sample;
};

/// Evaluates every face that has a limit on a grid of 2^level steps a side; its triangles span two steps, the points
/// between bound how far the surface bulges from them. It may itself miss a hit (several roots in one triangle,
/// features smaller than one); what it finds is on the surface.
class DenseCheck {
 public:
  /// Keeps a reference to the oracle. Level is from 1 to 10, else throws std::out_of_range. O(faces x 4^level)
  /// evaluations.
  DenseCheck(const Oracle& oracle, int level);
  ~DenseCheck();
  DenseCheck(DenseCheck&&) noexcept;

  /// The nearest surface point with tmin <= t <= tmax that Newton's iteration reaches from the cells along the ray:
  /// within 1e-11 of the diagonal from the ray's line, inside the face's domain. The direction must not be zero.
  std::optional<OracleHit> closest(const Vec3& origin, const Vec3& direction, double tmin, double tmax) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// True if the ray crosses the surface at the hit at more than a grazing angle, |n . d| > 1e-4 for unit vectors: a
/// closer hit is not a matter of rounding.
bool is_transversal(const OracleHit& hit, const Vec3& direction);

}  // namespace shaolin
