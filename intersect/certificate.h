#pragma once
/// What is proven of a hit.
#include <limits>

#include "../schemes/vec3.h"

namespace shaolin {

/// How far a hit can be trusted.
///
/// Of the exact method a hit is certified if on its cell of the parameters the map from (u, v) to the two distances
/// from the ray is proven one to one (its derivative, transformed, stays within less than 1 of the identity; from
/// differences of control points, so for the whole cell), and if the disc about (u, v) in which the contraction
/// principle then puts its zero lies where that polynomial is the surface: in the patch, or across its sides where it
/// continues the neighbours' to second order. The rounding of control points and of the frame counts as part of the
/// map. So there is one crossing of the surface by the ray in that cell, and no more. (The distance t of one within
/// `error` of an end of the ray's interval may lie on either side of it.)
///
/// Other hits are converged: a point of the surface that lies on the ray to within rounding. Whether the ray crosses
/// there, touches, or passes at a distance that rounding hides is open: at outlines, within rounding of creases and
/// boundaries, at extraordinary points, and where the surface has no polynomials. So are the hits of other methods.
/// Scene::certify() proves of most of those at creases and extraordinary points, and of others, that a disk of the
/// surface around the hit, across its patches, is crossed once (disk_proof.h). They are certified then, too.
///
/// A miss needs no certificate: the exact method drops what it passes on proof alone.
struct Certificate {
  enum class Status { converged, certified };

  Status status = Status::converged;
  /// The distance of the hit's position from the ray, evaluated in doubles; a length of the scene.
  double residual = 0;
  /// If certified, the position is no farther than this from the crossing of the exact surface by the ray, a length of
  /// the scene; otherwise infinite. The ray is the one given, or as Placement rounds it for an instance with a
  /// transform.
  double error = std::numeric_limits<double>::infinity();

  bool is_certified() const { return status == Status::certified; }
};

/// The distance of a point from the line origin + t direction; the direction has length 1.
inline double distance_from_line(const Vec3& point, const Vec3& origin, const Vec3& direction) {
  const Vec3 way = point - origin;
  return (way - way.dot(direction) * direction).norm();
}

}  // namespace shaolin
