#pragma once
/// Bounds of a patch from its control points, tight where the neighbourhood is that of a regular lattice.
#include "../schemes/patch.h"
#include "box.h"

namespace shaolin {

/// The plane that a patch deviates from: p = corner + u along_u + v along_v, and a box of what its surface adds to it.
struct FlatPart {
  Vec3 corner, along_u, along_v;
  Box remainder;

  Vec3 at(const Parameter& p) const { return corner + p.x() * along_u + p.y() * along_v; }
};

/// The box of a patch's limit: the hull of its points, expanded as its configuration says.
template <Scheme S>
Box hull_bound(const Patch<S>& patch) {
  Box box;
  for (const Vec3& point : patch.points) box.add(point);
  const double expansion = patch.configuration->hull_expansion();
  if (!std::isfinite(expansion)) {
    box.lower.setConstant(-std::numeric_limits<double>::infinity());
    box.upper.setConstant(std::numeric_limits<double>::infinity());
    return box;
  }
  return box.expanded(expansion);
}

/// The plane through three corners, and the patch of what is left (see flat_net.h), whose box is as small as the square
/// of the patch. Empty where there is no flat net.
template <Scheme S>
std::optional<FlatPart> flat_part(const Patch<S>& patch) {
  const std::optional<FlatNet>& net = patch.configuration->flat_net();
  if (!net) return {};
  const std::size_t last = Domain<S::face_kind>::corner_count - 1;
  FlatPart part{patch.points[0], patch.points[1] - patch.points[0], patch.points[last] - patch.points[0], {}};
  for (std::size_t i = 0; i < net->size(); ++i) part.remainder.add(patch.points[i] - part.at((*net)[i]));
  part.remainder = part.remainder.expanded(patch.configuration->hull_expansion());
  return part;
}

/// The box of a patch's limit.
template <Scheme S>
Box limit_bound(const Patch<S>& patch) {
  const std::optional<FlatPart> part = flat_part(patch);
  if (!part) return hull_bound(patch);
  Box box;
  for (const auto& corner : Domain<S::face_kind>::corners) box.add(part->at({corner[0], corner[1]}));
  return {box.lower + part->remainder.lower, box.upper + part->remainder.upper};
}

/// The same after so many splits of the patch, where its neighbourhood is not a lattice's: tighter, for the
/// neighbourhoods of small faces are small.
template <Scheme S>
Box split_limit_bound(const Patch<S>& patch, int splits) {
  if (splits == 0 || patch.configuration->flat_net()) return limit_bound(patch);
  Box box;
  for (const Patch<S>& child : patch.children()) box.add(split_limit_bound(child, splits - 1));
  return box;
}

}  // namespace shaolin
