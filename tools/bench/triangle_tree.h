#pragma once
/// CGAL's tree of boxes over triangles, as a peer.
#include <memory>
#include <optional>

#include "tools/validate/exact_triangles.h"

namespace shaolin {

/// CGAL::AABB_tree with inexact constructions and exact predicates, prepared for distances as its manual says.
class TriangleTree {
 public:
  /// Of triangles that are not degenerate; the others are left out. O(n log n).
  explicit TriangleTree(const TriangleSoup& soup);
  ~TriangleTree();

  /// The triangles' closest point.
  Vec3 closest(const Vec3& point) const;

  /// The t at which a ray with tmin = 0 and no end first meets a triangle.
  std::optional<double> first(const Ray& ray) const;

 private:
  class Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace shaolin
