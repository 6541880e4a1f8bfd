#pragma once
/// The planes RP and CP of Mueller et al. 2003, section 6, as a change of coordinates.
#include "box.h"
#include "net.h"
#include "spline_window.h"

namespace shaolin {

/// RP holds the ray and the normal of the start patch's plane TP, CP holds the ray and stands on RP. In the coordinates
/// (distance from RP, distance from CP, distance along the ray) the ray becomes the origin of a plane, and a surface
/// point is met where the first two vanish. Both planes are fixed per ray and start patch; any two planes through the
/// ray would do, but these two bound a flat patch most tightly.
class RayFrame {
 public:
  RayFrame(const TraversalRay& ray, const Vec3& patch_normal) : origin_(ray.origin), direction_(ray.direction) {
    // The product's rounding has a part along the ray, which counts where the product is small; that part is taken out.
    Vec3 across = direction_.cross(patch_normal);
    across -= across.dot(direction_) * direction_;
    // The ray runs along the normal to 16 roundings (or there is none): any plane through the ray holds it as well.
    if (!(across.norm() > 16 * unit_roundoff * patch_normal.norm())) across = direction_.unitOrthogonal();
    rp_ = across.normalized();
    cp_ = rp_.cross(direction_);
  }

  /// A point in the ray's coordinates.
  Vec3 project(const Vec3& point) const {
    const double x = point.x() - origin_.x(), y = point.y() - origin_.y(), z = point.z() - origin_.z();
    return {rp_.x() * x + rp_.y() * y + rp_.z() * z, cp_.x() * x + cp_.y() * y + cp_.z() * z,
            direction_.x() * x + direction_.y() * y + direction_.z() * z};
  }
  void project(const Net& from, Net& to) const {
    project(from, Axis::x, to.x);
    project(from, Axis::y, to.y);
    project(from, Axis::z, to.z);
  }

  /// One of the ray's coordinates: the distance from RP, from CP, or along the ray.
  enum class Axis { x, y, z };
  void project(const Net& from, Axis axis, std::array<double, 16>& to) const {
    const Projection project(origin_, along(axis));
    for (std::size_t i = 0; i < 16; i += 4) project(Four(&from.x[i]), Four(&from.y[i]), Four(&from.z[i])).store(&to[i]);
  }
  /// Of a polynomial's Bezier points.
  template <class Bezier>
  void project(const SplineWindow<Bezier>& from, Axis axis, std::array<double, 16>& to) const {
    const Projection project(origin_, along(axis));
    const auto row = [&](std::size_t j) { return project(from.row(0, j), from.row(1, j), from.row(2, j)); };
    from.to_bezier()({row(0), row(1), row(2), row(3)}, to);
  }

  /// A direction in the ray's coordinates.
  Vec3 turn(const Vec3& way) const { return {rp_.dot(way), cp_.dot(way), direction_.dot(way)}; }

  /// The bounds of points in the ray's coordinates.
  Box hull(const Net& points) const {
    Net projected;
    project(points, projected);
    return hull_of(projected);
  }
  template <class Points>
  Box hull(const Points& points) const {
    Box box;
    for (const Vec3& point : points) box.add(project(point));
    return box;
  }

  /// A bound on the error of a coordinate of a point that is known to within rounding, for points in `box`.
  ///
  /// With u = 2^-53, M the largest coordinate of the box and Q the largest of the box relative to the origin: the
  /// control points of a patch are the input's, put through up to l levels of convex combinations; each rounds with at
  /// most 6 u M, and convex combinations do not amplify, so 6 (l + 1) u M; levels above 8 come with patches so small
  /// that their sums are of nearly equal terms, 64 u M covers them. Subtracting the origin and a scalar product of
  /// three terms with a frame vector, itself good to 6 u, gives (1 + 3 + 6) u sqrt(3) Q < 18 u Q. What is no Bezier
  /// point yet becomes one then, by convex combinations along u and v, 4 u of a coordinate each: 14 u Q. Evaluation of
  /// the polynomial stays below 16 u of either. Twice the first sum, and a third more than the second, leave room for
  /// second order.
  static double error(const Vec3& origin, const Box& box) {
    const double relative =
        std::max((box.lower - origin).cwiseAbs().maxCoeff(), (box.upper - origin).cwiseAbs().maxCoeff());
    return unit_roundoff * (160 * box.largest_coordinate() + 64 * relative);
  }

 private:
  /// Of four points.
  struct Projection {
    Four ox, oy, oz, ax, ay, az;
    Projection(const Vec3& origin, const Vec3& along)
        : ox(origin.x()), oy(origin.y()), oz(origin.z()), ax(along.x()), ay(along.y()), az(along.z()) {}
    Four operator()(Four x, Four y, Four z) const { return ax * (x - ox) + ay * (y - oy) + az * (z - oz); }
  };
  const Vec3& along(Axis axis) const { return axis == Axis::x ? rp_ : axis == Axis::y ? cp_ : direction_; }

  Vec3 origin_, direction_, rp_, cp_;
};

}  // namespace shaolin
