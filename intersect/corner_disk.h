#pragma once
/// The surface close to a vertex, as a ray sees it.
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "../schemes/domain.h"
#include "../schemes/limit_sample.h"

namespace shaolin {

class LimitSurface;

/// True within 1e-6 of a corner of the face.
bool is_at_corner(const SurfaceParameter& at);

/// The corner of its face that a place is nearest to.
SurfaceParameter nearest_corner(const SurfaceParameter& at, bool triangular);

/// The places so far from a corner of a face on its two sides there: on the one that leads to the next vertex,
/// counter-clockwise, and on the one that comes from the last. `far` is in parameters, in (0, 1].
std::pair<Parameter, Parameter> sides_at(const Parameter& corner, double far, bool triangular);

/// The angle that a face takes around the ray at one of its corners: that between the sides, of which short chords will
/// do, for the angles of all faces together are a multiple of 2 pi. (Tangents may be missing.)
double corner_angle(const SurfaceParameter& at, const LimitSurface& surface, const Vec3& direction);

/// Of some faces all that is closer than a radius, in parameters, to one corner each: where these are all faces around
/// one vertex, a disk. Its rim goes round the ray as often as the ray passes the disk from below more often than from
/// above, whatever the surface does inside: near a pole or a tip, where crossings may lie closer to each other than can
/// be told apart, their sum can still be told.
class CornerDisk {
 public:
  /// Of each face in `places` the corner that one of its places is nearest to; with a radius of twice what it takes to
  /// hold them all. Empty if that is more than half of a face. Places are in the order of (face, sub).
  static std::optional<CornerDisk> around(std::span<const SurfaceParameter> places, bool triangular);

  bool contains(const SurfaceParameter& at) const;
  double radius() const { return radius_; }

  /// Makes the disk larger, until all of its rim is farther than `clearance` from the ray, and gives the turns of the
  /// rim about the ray's direction. Empty if there is no such disk, or if its rim is not closed. `through` is a point
  /// of the ray. O(faces x log(1 / radius)) evaluations.
  std::optional<int> grow_and_wind(const LimitSurface& surface, const Vec3& through, const Vec3& direction,
                                   double clearance);

 private:
  std::optional<double> wind(const LimitSurface& surface, const Vec3& through, const Vec3& direction,
                             double clearance) const;

  std::vector<SurfaceParameter> corners_;
  double radius_ = 0;
  bool triangular_ = false;
};

}  // namespace shaolin
