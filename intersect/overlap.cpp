#include "overlap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_3.h>

#include <algorithm>
#include <vector>

namespace shaolin {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = Kernel::Exact_kernel;
using Edge = std::array<int, 2>;

/// An edge and what it certainly stays within along one axis of the plane.
struct Span {
  double first, last;
  Edge edge;
};

/// Points seen along a normal: signs of what they span, exactly.
class ProjectedPoints {
 public:
  ProjectedPoints(std::span<const Vec3> points, const Vec3& normal)
      : points_(points), normal_(normal.x(), normal.y(), normal.z()), traits_(normal_) {
    const Vec3 n = normal.stableNormalized(), u = n.unitOrthogonal(), v = n.cross(u), origin = points.front();
    double extent = 0;
    flat_.reserve(points.size());
    for (const Vec3& p : points) {
      const Vec3 d = p - origin;
      is_finite_ &= d.allFinite();
      extent = std::max(extent, d.cwiseAbs().maxCoeff());
      flat_.emplace_back(u.dot(d), v.dot(d));
    }
    // A subtraction, a dot product of three terms, axes that are off by some units in the last place, and sqrt(3)
    // between the largest coordinate and the length: below 32 u.
    error_ = 32 * 0x1p-53 * extent;
  }

  bool is_finite() const { return is_finite_; }

  Span span(const Edge& e) const {
    const double a = at(e[0]).x(), b = at(e[1]).x();
    return {std::min(a, b) - error_, std::max(a, b) + error_, e};
  }

  /// False only if the edges' boxes are certainly apart.
  bool may_meet(const Edge& e, const Edge& f) const {
    const Eigen::Vector2d &a = at(e[0]), &b = at(e[1]), &c = at(f[0]), &d = at(f[1]);
    const auto apart = [&](int axis) {
      return std::max(a[axis], b[axis]) + 2 * error_ < std::min(c[axis], d[axis]) ||
             std::max(c[axis], d[axis]) + 2 * error_ < std::min(a[axis], b[axis]);
    };
    return !apart(0) && !apart(1);
  }

  /// The sign of the projected triangle's area. The determinant in double is certain where it is larger than what the
  /// errors of the differences, 2 error_ each, can add, and its own roundings, which are less.
  int orientation(int a, int b, int c) const {
    const Eigen::Vector2d d = at(b) - at(a), e = at(c) - at(a);
    const double determinant = d.x() * e.y() - d.y() * e.x();
    const double bound = 4 * error_ * (d.cwiseAbs().sum() + e.cwiseAbs().sum() + 4 * error_) + underflow;
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
    return static_cast<int>(traits_.orientation_2_object()(point(a), point(b), point(c)));
  }

  /// The sign of (b - a) . (c - a) in the projection: a cross product with the normal is the projection, turned and
  /// scaled.
  int dot_sign(int a, int b, int c) const {
    const CGAL::Cartesian_converter<Kernel, Exact> exact;
    const Exact::Vector_3 n = exact(normal_);
    const Exact::Vector_3 d = CGAL::cross_product(exact(point(b)) - exact(point(a)), n);
    const Exact::Vector_3 e = CGAL::cross_product(exact(point(c)) - exact(point(a)), n);
    return static_cast<int>(CGAL::sign(CGAL::scalar_product(d, e)));
  }

  bool is_point(const Edge& e) const {
    return (at(e[1]) - at(e[0])).cwiseAbs().maxCoeff() <= 4 * error_ + underflow && dot_sign(e[0], e[1], e[1]) == 0;
  }

 private:
  static constexpr double underflow = 1e-290;  // products below may have lost all their digits

  const Eigen::Vector2d& at(int i) const { return flat_[static_cast<std::size_t>(i)]; }
  Kernel::Point_3 point(int i) const {
    const Vec3& p = points_[static_cast<std::size_t>(i)];
    return {p.x(), p.y(), p.z()};
  }

  std::span<const Vec3> points_;
  Kernel::Vector_3 normal_;
  CGAL::Projection_traits_3<Kernel> traits_;
  std::vector<Eigen::Vector2d> flat_;
  double error_ = 0;
  bool is_finite_ = true;
};

/// Two edges that share their end a overlap if they leave it in the same direction.
bool overlap_from(const ProjectedPoints& net, int a, int b, int c) {
  return net.orientation(a, b, c) == 0 && net.dot_sign(a, b, c) > 0;
}

/// Edges without a common end, neither of which is a point: whether they meet.
bool meet(const ProjectedPoints& net, const Edge& e, const Edge& f) {
  const int c = net.orientation(e[0], e[1], f[0]), d = net.orientation(e[0], e[1], f[1]);
  if (c * d > 0) return false;
  if (c == 0 && d == 0) {  // on one line: one's end lies in the other
    const auto holds = [&](const Edge& edge, int p) { return net.dot_sign(p, edge[0], edge[1]) <= 0; };
    return holds(e, f[0]) || holds(e, f[1]) || holds(f, e[0]);
  }
  return net.orientation(f[0], f[1], e[0]) * net.orientation(f[0], f[1], e[1]) <= 0;
}

bool collide(const ProjectedPoints& net, const Edge& e, const Edge& f) {
  for (const int i : {0, 1})
    for (const int j : {0, 1})
      if (e[static_cast<std::size_t>(i)] == f[static_cast<std::size_t>(j)])
        return overlap_from(net, e[static_cast<std::size_t>(i)], e[static_cast<std::size_t>(1 - i)],
                            f[static_cast<std::size_t>(1 - j)]);
  return net.may_meet(e, f) && meet(net, e, f);
}

}  // namespace

bool is_planar_straight_line_graph(std::span<const Vec3> points, std::span<const Edge> edges, const Vec3& normal) {
  if (!normal.allFinite() || normal.isZero(0)) return false;
  if (edges.empty()) return true;
  const ProjectedPoints net(points, normal);
  if (!net.is_finite()) return false;
  if (std::any_of(edges.begin(), edges.end(), [&](const Edge& e) { return net.is_point(e); })) return false;
  // From left to right: an edge is compared with those that begin before it ends.
  std::vector<Span> spans;
  spans.reserve(edges.size());
  for (const Edge& e : edges) spans.push_back(net.span(e));
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < spans.size(); ++i)
    for (std::size_t j = i + 1; j < spans.size() && spans[j].first <= spans[i].last; ++j)
      if (collide(net, spans[i].edge, spans[j].edge)) return false;
  return true;
}

}  // namespace shaolin
