#pragma once
/// A ring as the masks of smooth surfaces read it: closed.
#include <map>

#include "ring.h"
#include "scheme.h"

namespace shaolin {

/// A weighted sum of points.
class Stencil {
 public:
  void add(int point, double weight) {
    if (weight != 0) weights_[point] += weight;
  }
  void add(const Stencil& other, double weight) {
    for (const auto& [point, share] : other.weights_) add(point, weight * share);
  }

  /// Points and weights, by point.
  const std::map<int, double>& weights() const { return weights_; }

  Vec3 of(const Vec3* points) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [point, weight] : weights_) sum += weight * points[point];
    return sum;
  }

 private:
  std::map<int, double> weights_;
};

/// The part of a ring around one of its faces or spokes. A ring that infinitely sharp edges (or a boundary) do not cut
/// is taken as it is. (One such edge alone ends in a dart, which does not cut; at a corner it does, for a mesh that is
/// cut open along it has the same surface.) A sector of k faces between two of them is continued to valence 2 k by
/// mirror images: laid out flat with the crease straight, a point beyond is the image of the point on this side in the
/// crease, or 2 foot - p, where the foot of the perpendicular from p stands on the line from the vertex to its
/// neighbour along the crease. At regular valence these are the phantom points that continue a spline beyond its
/// boundary (see regular_layout.h); at any valence the images of a flat star close it, so a scheme that keeps planes
/// keeps them here.
class ClosedRing {
 public:
  /// Around the spoke in that place; it must not be infinitely sharp.
  static ClosedRing at_spoke(const Ring& ring, std::size_t spoke) { return {ring, spoke, spoke}; }
  /// Around the face in that place, counted from its first spoke.
  static ClosedRing at_face(const Ring& ring, std::size_t face) { return {ring, face, face + 1}; }

  int valence() const { return open_ ? 2 * faces_ : faces_; }

  /// Adds a mask of this valence. The diagonal of a face that is no quad is the parallelogram's over its two spokes.
  void add_to(Stencil& stencil, const RingMask& mask) const;

 private:
  ClosedRing(const Ring& ring, std::size_t low, std::size_t high);

  /// Spoke and face in place i of the sector.
  const Ring::Spoke& spoke(int i) const { return ring_.spokes[place(i, ring_.spokes.size())]; }
  const FaceSides& face(int i) const { return ring_.faces[place(i, ring_.faces.size())]; }
  std::size_t place(int i, std::size_t size) const { return static_cast<std::size_t>(first_ + i) % size; }

  void add_diagonal(Stencil& stencil, int i, double weight) const;
  void add_twice_foot(Stencil& stencil, double spokes_from_crease, double distance, double weight) const;

  const Ring& ring_;
  bool open_ = false;
  int first_ = 0;  ///< place in the ring of the sector's first spoke
  int faces_ = 0;
  int start_ = 0;  ///< where masks count from, in the sector
};

}  // namespace shaolin
