#pragma once
/// Work counters of rays, and their sums.
#include <cstdint>

namespace shaolin {

/// What queries did; each thread counts its own.
struct RayCounters {
  std::uint64_t hull_tests = 0;  ///< RP/CP tests of a patch's control points
  std::uint64_t cells = 0;       ///< parameter cells that the exact finish looked at, or triangles of a tessellation
  std::uint64_t newton_steps = 0;
  std::uint64_t uncertified = 0;  ///< hits that were given as answers, or decided them, without proof (certificate.h)

  // Of Method::chord and Method::a3:
  std::uint64_t chord_tests = 0;   ///< leaves whose chord triangles rays were intersected with
  std::uint64_t w_cases = 0;       ///< neighbours put into a shadow list because a patch's children left a gap to them
  std::uint64_t gap_polygons = 0;  ///< asked between leaves of different levels
  std::uint64_t gap_polygons_hit = 0;
  std::uint64_t border_areas_hit = 0;
  std::uint64_t depth_bounds = 0;  ///< times that the depth bound ended refinement

  RayCounters& operator+=(const RayCounters& other) {
    hull_tests += other.hull_tests;
    cells += other.cells;
    newton_steps += other.newton_steps;
    uncertified += other.uncertified;
    chord_tests += other.chord_tests;
    w_cases += other.w_cases;
    gap_polygons += other.gap_polygons;
    gap_polygons_hit += other.gap_polygons_hit;
    border_areas_hit += other.border_areas_hit;
    depth_bounds += other.depth_bounds;
    return *this;
  }
};

/// Work done since the scene was made; the sums over all threads.
struct Statistics : RayCounters {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;
  std::uint64_t points = 0;           ///< asked for their closest point
  std::uint64_t shapes = 0;           ///< asked for overlaps, contacts of sweeps, or faces to pick
  std::uint64_t faces = 0;            ///< faces with a limit surface (n-gons count once per corner)
  std::uint64_t faces_touched = 0;    ///< of these, the ones that any ray made refine
  std::uint64_t patches_split = 0;    ///< patches whose four children were made; again, if they were evicted
  std::uint64_t patches_evicted = 0;  ///< start patches dropped, with all made of them, for a memory budget
  std::uint64_t bytes = 0;            ///< memory held by patches and their tables

  std::uint64_t invalid_patches = 0;     ///< start patches that overlap themselves in projection (eq. 6): split
  std::uint64_t unresolved_patches = 0;  ///< of their parts, those that still do at the depth bound
};

}  // namespace shaolin
