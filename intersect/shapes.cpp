#include "shapes.h"

#include <sstream>

#include "../schemes/errors.h"
#include "convex.h"

namespace shaolin {

namespace {

std::string text(const Vec3& v) {
  std::ostringstream out;
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return out.str();
}

void check_point(const char* what, const Vec3& point) {
  if (!point.allFinite()) throw InputError(std::string(what) + " " + text(point) + " is not finite");
}

void check_radius(const char* what, double radius) {
  if (radius > 0 && std::isfinite(radius)) return;
  std::ostringstream out;
  out << what << " " << radius << " is out of range; expected a positive length";
  throw InputError(out.str());
}

void check_length(const char* what, double length) {
  if (length >= 0 && std::isfinite(length)) return;
  std::ostringstream out;
  out << what << " " << length << " is out of range; expected a finite length of at least 0";
  throw InputError(out.str());
}

}  // namespace

Frustum Frustum::of_view(const Vec3& eye, const std::vector<Vec3>& corners) {
  if (corners.size() < 3)
    throw InputError("a view has " + std::to_string(corners.size()) + " corners; expected three or more");
  Vec3 middle = Vec3::Zero();
  for (const Vec3& corner : corners) middle += corner.normalized();
  Frustum frustum;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &here = corners[i], &next = corners[(i + 1) % corners.size()];
    Vec3 normal = here.normalized().cross(next.normalized());
    if (!(normal.norm() > 0))
      throw InputError("the view's corners " + text(here) + " and " + text(next) + " span no plane");
    normal.normalize();
    if (normal.dot(middle) > 0) normal = -normal;
    frustum.sides.push_back({normal, normal.dot(eye)});
  }
  return frustum;
}

void check(const Sphere& sphere) {
  check_point("the sphere's centre", sphere.centre);
  check_radius("the sphere's radius", sphere.radius);
}

void check(const OrientedBox& box) {
  check_point("the box's centre", box.centre);
  for (const double half : box.half) check_length("half the box's extent", half);
  constexpr double tolerance = 1e-9;
  if (!(((box.axes.transpose() * box.axes) - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= tolerance))
    throw InputError("the box's axes " + text(box.axes.col(0)) + ", " + text(box.axes.col(1)) + " and " +
                     text(box.axes.col(2)) + " are not unit vectors at right angles");
}

void check(const Capsule& capsule) {
  check_point("the capsule's end", capsule.a);
  check_point("the capsule's end", capsule.b);
  check_radius("the capsule's radius", capsule.radius);
}

void check(const Triangle& triangle) {
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) check_point("the triangle's corner", corner);
}

void check(const SphereSweep& sweep) {
  check_point("the sphere's start", sweep.start);
  check_radius("the sphere's radius", sweep.radius);
  check_point("the sphere's displacement", sweep.displacement);
  check_point("the sphere's end", sweep.start + sweep.displacement);
}

void check(const Frustum& frustum) {
  if (frustum.sides.empty()) throw InputError("the frustum has no sides; expected one half-space or more");
  for (const HalfSpace& side : frustum.sides) {
    check_point("the normal of the frustum's side", side.normal);
    if (side.normal.isZero(0)) throw InputError("the normal of the frustum's side is zero");
    if (!std::isfinite(side.offset)) throw InputError("the offset of the frustum's side is not finite");
  }
}

Box bounds(const Sphere& sphere) { return Box{sphere.centre, sphere.centre}.grown(sphere.radius); }

Box bounds(const OrientedBox& box) {
  const Vec3 reach = box.axes.cwiseAbs() * box.half;
  return {box.centre - reach, box.centre + reach};
}

Box bounds(const Capsule& capsule) {
  return Box{capsule.a.cwiseMin(capsule.b), capsule.a.cwiseMax(capsule.b)}.grown(capsule.radius);
}

Box bounds(const Triangle& triangle) {
  return {triangle.a.cwiseMin(triangle.b).cwiseMin(triangle.c), triangle.a.cwiseMax(triangle.b).cwiseMax(triangle.c)};
}

std::unique_ptr<Convex> convex(const Sphere& sphere, const QueryFrame& frame) {
  return std::make_unique<Simplex>(std::vector{frame(sphere.centre)}, frame.scale * sphere.radius);
}

/// The axes are made unit and square to rounding: checked ones are to a billionth only.
std::unique_ptr<Convex> convex(const OrientedBox& box, const QueryFrame& frame) {
  Eigen::Matrix3d axes;
  axes.col(0) = box.axes.col(0).normalized();
  axes.col(1) = (box.axes.col(1) - box.axes.col(1).dot(axes.col(0)) * axes.col(0)).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return std::make_unique<Block>(frame(box.centre), axes, frame.scale * box.half);
}

std::unique_ptr<Convex> convex(const Capsule& capsule, const QueryFrame& frame) {
  return std::make_unique<Simplex>(std::vector{frame(capsule.a), frame(capsule.b)}, frame.scale * capsule.radius);
}

std::unique_ptr<Convex> convex(const Triangle& triangle, const QueryFrame& frame) {
  return std::make_unique<Simplex>(std::vector{frame(triangle.a), frame(triangle.b), frame(triangle.c)}, 0);
}

}  // namespace shaolin
