#pragma once
/// Where a ray passes a surface: each crossing once, out of what the patches report.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "ray.h"

namespace shaolin {

class LimitSurface;

/// Which way a ray goes on at a hit.
enum class Sense : std::int8_t {
  enters = -1,  ///< against the normal: into a body whose normals point outward
  touches = 0,  ///< on the side that it came from, or along the surface
  leaves = 1    ///< with the normal
};

/// One of all the hits of a ray.
struct Crossing {
  Hit hit;
  Sense sense = Sense::touches;
};

/// How many of them are not certified.
std::uint64_t count_uncertified(const std::vector<Crossing>& crossings);

/// A point that one patch reports: on the ray to within rounding.
struct Contact {
  Hit hit;
  double distance;     ///< along the ray
  double uncertainty;  ///< by how much `distance` may be off
  double error;        ///< by how much coordinates across the ray may be off
  bool is_proven;      ///< the only one of its parameter cell, where the surface is not tangent to the ray
  bool is_coarse;      ///< stands for a cell that was too large for rounding to be all that its place is off by
};

/// The closest hit between two distances along the ray, if there is one.
using ClosestBetween = std::function<std::optional<Hit>(double begin, double end)>;

/// How far off along the ray a contact may be whose coordinates carry an error, and which stands for a piece of surface
/// that reaches so far: a point is on the ray to within twice the error, and on a slope of cosine |n.d| against the ray
/// that is as much over the cosine along it. Where the cosine is below 1e-4 a surface turns away within 1e-4 of its
/// radius of curvature, so that the next crossing is at least 1e-8 of it away.
inline double contact_uncertainty(double error, double reach, double cosine) {
  return reach + 4 * error / std::max(cosine, 1e-4);
}

/// What a surface's patches report of one ray, as crossings in ascending order of t.
///
/// A ray through an edge or a vertex is reported by all faces there, or by some. Contacts are one crossing if they are
/// no farther apart than their uncertainties together and belong to one face, or to faces that share a vertex. The
/// nearest stands for all, or the least uncertain that may be the same point (at a corner a ray may graze one face and
/// cross another); of equal ones that of the lowest face and sub. If the nearest is coarse (of a ray that runs along
/// the surface), the closest hit does that lies where the contacts may be; without one there is no crossing.
///
/// Which way it goes is a matter of winding: around the ray, the faces at the point turn by 2 pi in all if the surface
/// crosses it there, with the sign of n.d, and by 0 if the surface touches it (an edge seen as an outline). Where faces
/// do not agree at a vertex, a disk around it tells (corner_disk.h). Elsewhere a face counts pi (of its edge, or of all
/// of its inner points), and of a corner the angle between its sides; contacts of one face with opposite signs (a
/// double root) cancel. Where a ray goes in by less than rounding can tell before it comes out again, it touches,
/// unless both ends are found; if one is near a vertex, a disk around that tells. O(n log n + n f) for contacts of f
/// faces, and evaluations at vertices.
std::vector<Crossing> crossings(std::vector<Contact> contacts, const LimitSurface& surface, const Vec3& direction,
                                const ClosestBetween& closest);

}  // namespace shaolin
