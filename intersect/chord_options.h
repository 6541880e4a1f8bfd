#pragma once
/// Where chord faces stop being refined.

namespace shaolin {

/// Where Method::chord and Method::a3 stop refining (Mueller et al. 2003, section 7). A patch's projected size is that
/// of its longest chord, seen along the ray at the distance of its centre, in pixels: in footprints of the ray (see
/// Footprint; a ray without one knows no pixels, and epsilon alone decides).
struct ChordOptions {
  /// Bound of chord deviation / |cosine of chord normal and ray|; a length of the scene's, > 0. In an instance that
  /// scales its axes differently it stands for what the ray's direction becomes, so deviations across the ray may be
  /// larger or smaller by the ratio of the scales. Without a footprint, work and memory grow as 1 / epsilon where a ray
  /// runs along a straight line of a surface.
  double epsilon = 0.01;
  double min_size = 2;   ///< pixels; what is smaller is not refined; >= 0
  double max_size = 12;  ///< pixels; what is larger is refined whatever epsilon says; >= min_size

  /// The paper measures deviation at the middles of edges. An edge that crosses its chord there looks straight; so the
  /// normals at its ends have a say, too, which changes nothing at edges that bend one way like a parabola.
  bool end_normals = true;

  /// Parts of the algorithm that a test or a measurement leaves out to show what they are for.
  bool w_cases = true, gap_polygons = true, border_areas = true, valid_patches = true;
  bool stand_in_borders = false;  ///< hulls of the paper's c(t) beside irregular vertices, instead of proven bounds
};

}  // namespace shaolin
