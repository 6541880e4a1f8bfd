#pragma once
/// The parts of a patch that are valid start patches (section 8.1 of the paper): split where it may overlap itself.
#include <cstdint>
#include <utility>
#include <vector>

#include "chord_plane.h"
#include "overlap.h"

namespace shaolin {

/// A part of a start patch, to be traced as a start patch of its own.
template <Scheme S>
struct ValidPart {
  Patch<S> patch;
  std::vector<std::uint8_t> path;    ///< the children that lead to it from the start patch; empty: the whole
  Vec3 plane_normal = Vec3::Zero();  ///< of its own TP; zero if its corners span no plane
  bool resolved = false;             ///< false: not known to be valid, and splitting is given up
};

/// What became of patches.
struct ValidityCounts {
  std::size_t patches = 0;     ///< start patches that were asked
  std::size_t split = 0;       ///< of these, not valid as they are
  std::size_t parts = 0;       ///< what they fall into, themselves if they were not split
  std::size_t unresolved = 0;  ///< of the parts

  ValidityCounts& operator+=(const ValidityCounts& other) {
    patches += other.patches;
    split += other.split;
    parts += other.parts;
    unresolved += other.unresolved;
    return *this;
  }
};

/// How often a patch is split at most. Let the surface be regular, s the length of the largest second difference of
/// its control net and d the least singular value of its derivative, per step of the net, in the plane of any part.
/// Second differences of a B-spline's net are means of those one level up, divided by 4, derivatives per step are
/// divided by 2. Edges along u differ by at most 5/2 second differences from their mean (one step along u, 3/2 along
/// v), those along v likewise. So after l splits projects_without_overlap() holds as soon as
///
///     2 (5/2 s / (2^l d))^2 <= 0.9,    l >= log2(3.73 s / d),
///
/// and 8 splits are enough for s <= 68 d: a surface whose radius of curvature is a seventieth of a step of its net.
/// Around irregular corners the ratio falls by mu / lambda a level in place of 1/2 (lambda: the tangents' eigenvalue,
/// mu: the next), slower at high valence. Where d is 0 (the surface has a fold's edge or a cusp) no depth is enough.
inline constexpr int most_valid_splits = 8;

/// The levels that a patch's semi-sharp edges and vertices last: until then it is a part of a crease, with points
/// beyond that are not left out.
template <Scheme S>
int semi_sharp_levels(const Configuration<S>& configuration) {
  float sharpest = 0;
  const auto add = [&](float value) {
    if (is_semi_sharp(value)) sharpest = std::max(sharpest, value);
  };
  for (const Ring& ring : configuration.neighbourhood().rings) {
    add(ring.sharpness);
    for (const Ring::Spoke& spoke : ring.spokes) add(spoke.sharpness);
  }
  return static_cast<int>(std::ceil(sharpest));
}

/// Calls visit(const ValidPart<S>&) for parts that together are the patch: itself if it projects without overlap to its
/// TP, else its children, and so on, each in its own plane; level by level. Parts that are not valid after
/// most_valid_splits splits (and those that semi-sharpness lasts) are visited as not resolved. So are all that are left
/// where a level leaves more than 4 2^l parts: a curve (a fold's edge, a crease) meets so many of the 4^l, more mean
/// that the surface is degenerate over an area. Schemes without polynomials are not split, for nothing would be known
/// of their parts either. One test for most patches; at most 16 2^l at level l.
template <Scheme S, class Visit>
ValidityCounts for_each_valid_part(const Patch<S>& start, Visit visit) {
  const bool is_decidable = basis_of(start.configuration->scheme()) != Basis::none;
  const int most_splits = is_decidable ? most_valid_splits + semi_sharp_levels(*start.configuration) : 0;
  ValidityCounts counts{1, 0, 0, 0};
  std::vector<ValidPart<S>> level{{start, {}}};
  for (int splits = 0; !level.empty(); ++splits) {
    std::vector<ValidPart<S>> left;
    for (ValidPart<S>& part : level) {
      part.plane_normal = chord_plane_normal(part.patch);
      part.resolved = projects_without_overlap(part.patch, part.plane_normal);
      if (!part.resolved) {
        left.push_back(std::move(part));
        continue;
      }
      ++counts.parts;
      visit(std::as_const(part));
    }
    if (splits == 0) counts.split = is_decidable && !left.empty();
    level.clear();
    if (splits == most_splits || left.size() > (std::size_t{4} << splits)) {
      counts.parts += left.size();
      counts.unresolved += left.size();
      for (const ValidPart<S>& part : left) visit(part);
      break;
    }
    for (const ValidPart<S>& part : left) {
      std::uint8_t k = 0;
      for (Patch<S>& child : part.patch.children()) {
        std::vector<std::uint8_t> path = part.path;
        path.push_back(k++);
        level.push_back({std::move(child), std::move(path)});
      }
    }
  }
  return counts;
}

}  // namespace shaolin
