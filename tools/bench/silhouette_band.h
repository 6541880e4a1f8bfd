#pragma once
/// Where an answer by chords may differ from the exact one in kind: near outlines.
#include <optional>

#include "intersect/scene.h"

namespace shaolin {

/// The width of the band: how far the chords that chord and a3 stop at may lie from the limit surface, seen across a
/// ray, at a distance along it (a length of the scene's).
///
/// Refinement stops where the chord's edges (of quads also the centre) are off the limit by less than epsilon |cos| <=
/// epsilon at their middles, or where the longest chord is seen under min_size pixels, and then the patch is off its
/// chord by less than that. What the middles say of the inside: the deviation of a triangle of second order is 4 sum
/// (b_i b_j d_ij) over its edges' deviations d_ij in barycentric coordinates b, at most 4/9 (3 d) = 4/3 d; of a quad of
/// second order in u and v, with deviations up to d at nine points that vanish at the corners, at most 1.39 d (l(u)
/// l(v) + l(u) s(v) + s(u) l(v) with Lagrange's l = 4 x (1 - x) and s = |1 - 2 x|, at x = 0.32). Twice d leaves room
/// for terms of higher order, which halve with each level, and for the fold between a quad's two triangles: no proof,
/// but a bound that is stated and searched for exceptions.
inline constexpr double band_factor = 2;
double band_width(const ChordOptions& options, const Footprint& footprint, double distance);

/// What exact rays answer that run beside a ray, parallel to it, at up to `width` across: in eight directions, at
/// shares of the width from 1 down to 2^-24. (The least matter to rays that dip into one sheet by less than rounding
/// shows, and graze the next: any larger shift loses both.) Their intervals are the ray's, and the ray's with a width
/// more, or less, at either end, for an interval may begin or end in the band of a surface.
struct SilhouetteBand {
  bool any_miss = false;
  double nearest, farthest;  ///< of all hits, as lengths along the ray; nearest > farthest if there are none

  /// True if an answer (a length along the ray, or a miss) is one that a shift by `width` explains: a miss if any of
  /// these rays misses, a hit if it lies between their hits, `width` more at either end. Where the surface goes on to
  /// all sides, hits lie within its slope there, and misses are not explained; at an outline all between the sheet and
  /// what is behind it is.
  bool explains(const std::optional<double>& distance, double width) const {
    return distance ? nearest - width <= *distance && *distance <= farthest + width : any_miss;
  }

  /// True if one of these rays meets nothing nearer than `width` before that distance.
  bool lets_through(double distance, double width) const { return any_miss || farthest >= distance - width; }
};

/// True if a way past the surface leads along a ray to `distance` (a length along it; none: to its end) within `width`
/// of it: on one of the band's shifts, then across, meeting nothing, to a place between two of the ray's own hits, on
/// along another shift, and so on. The ray's interval and the distance are taken a width shorter at either end.
///
/// Chords move each sheet by itself: a ray that grazes two sheets, which cover it from opposite sides, may miss the
/// chords of both, although every shift that leaves the one behind runs into the other. A body whose chords cannot be
/// missed closes all ways. O(88 h^2) queries for h hits.
bool leads_past(const Scene& exact, Ray ray, double width, const std::optional<double>& distance = {});

/// True if the surface is found within `width` of a point: along a unit normal or against it, from the point and from
/// eight points half as far around it.
bool is_near(const Scene& exact, const Vec3& point, const Vec3& normal, double width);

/// 264 queries, none shorter. A ray whose answer is not the exact one lies *outside of the band* if this does not
/// explain the answer, nor do several shifts: a miss is also as it should be if a way through the band leads past all,
/// a hit if one ray of the band is let through to it, or a way leads there, and the surface is near it. (A tangent ray
/// dips into a sheet by 1e-8 and runs on beside it; chords that miss the dip may meet it a little farther on, where
/// every shift that meets the sheet has met it before.)
SilhouetteBand silhouette_band(const Scene& exact, const Ray& ray, double width);

}  // namespace shaolin
