#include "tools/bench/triangle_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace shaolin {
namespace {

using TreeKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<TreeKernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<TreeKernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<TreeKernel, Primitive>>;

TreeKernel::Point_3 tree_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

class TriangleTree::Implementation {
 public:
  explicit Implementation(const TriangleSoup& soup) {
    triangles_.reserve(soup.triangles.size());
    const auto corner = [&](int v) { return tree_point(soup.points[static_cast<std::size_t>(v)]); };
    for (const auto& [a, b, c] : soup.triangles)
      if (const TreeKernel::Triangle_3 triangle(corner(a), corner(b), corner(c)); !triangle.is_degenerate())
        triangles_.push_back(triangle);
    tree_.rebuild(triangles_.cbegin(), triangles_.cend());
    tree_.accelerate_distance_queries();
  }

  Vec3 closest(const Vec3& point) const {
    const TreeKernel::Point_3 at = tree_.closest_point(tree_point(point));
    return {at.x(), at.y(), at.z()};
  }

  std::optional<double> first(const Ray& ray) const {
    const Vec3& d = ray.direction;
    const auto met =
        tree_.first_intersection(TreeKernel::Ray_3(tree_point(ray.origin), TreeKernel::Vector_3(d.x(), d.y(), d.z())));
    if (!met) return {};
    // A triangle that holds the ray is met in a segment.
    const auto* const segment = boost::get<TreeKernel::Segment_3>(&met->first);
    const TreeKernel::Point_3 at = segment ? segment->source() : boost::get<TreeKernel::Point_3>(met->first);
    return (Vec3(at.x(), at.y(), at.z()) - ray.origin).dot(d) / d.squaredNorm();
  }

 private:
  Triangles triangles_;
  Tree tree_;
};

TriangleTree::TriangleTree(const TriangleSoup& soup) : implementation_(std::make_unique<Implementation>(soup)) {}
TriangleTree::~TriangleTree() = default;

std::optional<double> TriangleTree::first(const Ray& ray) const { return implementation_->first(ray); }
Vec3 TriangleTree::closest(const Vec3& point) const { return implementation_->closest(point); }

}  // namespace shaolin
