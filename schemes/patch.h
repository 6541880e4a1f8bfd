#pragma once
/// A patch: the part of the limit surface that belongs to one face, as a self-contained value.
#include <vector>

#include "configuration.h"

namespace shaolin {

/// A configuration and its control points. The limit patch lies in the convex hull of the points, or within
/// Configuration::hull_expansion() of it; splitting gives the children's patches, without any mesh.
template <Scheme S>
struct Patch {
  using Regular = RegularPatch<S::face_kind>;

  const Configuration<S>* configuration = nullptr;
  std::vector<Vec3> points;

  /// Child k, in the order of Domain; child k of an n-gon is the quad at its corner k. O(points).
  Patch child(int k) const {
    const auto& split = configuration->child(k);
    Patch result{split.configuration, std::vector<Vec3>(static_cast<std::size_t>(split.program.point_count()))};
    split.program.run(points.data(), result.points.data());
    return result;
  }

  /// All children, in their order; to the last bit those of child(). `made` becomes the points of all of them, as
  /// Configuration::split() numbers them. O(points).
  std::vector<Patch> children() const {
    std::vector<Vec3> made;
    return children(made);
  }
  std::vector<Patch> children(std::vector<Vec3>& made) const {
    const auto& split = configuration->split();
    made.resize(static_cast<std::size_t>(split.program.point_count()));
    split.program.run(points.data(), made.data());
    std::vector<Patch> result;
    result.reserve(split.children.size());
    for (const auto& part : split.children) {
      Patch& child = result.emplace_back(Patch{part.configuration, {}});
      child.points.reserve(part.points.size());
      for (const int point : part.points) child.points.push_back(made[static_cast<std::size_t>(point)]);
    }
    return result;
  }

  bool is_regular() const { return configuration->is_regular(); }

  /// The polynomial patch of a regular configuration.
  Regular regular() const { return configuration->layout()->patch(points.data()); }
};

}  // namespace shaolin
