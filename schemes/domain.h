#pragma once
/// The parameter domain of a patch and how the four children of a split lie in it.
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "scheme.h"

namespace shaolin {

/// Parameters (u, v) in a patch.
using Parameter = Eigen::Vector2d;

/// A place in one of the four children, in the child's own parameters.
struct ChildParameter {
  int child;
  Parameter at;
};

template <FaceKind kind>
struct Domain;

/// The unit square. Children 0..3 keep the parent's orientation and hold its corners 0..3.
template <>
struct Domain<FaceKind::quad> {
  static constexpr int corner_count = 4;
  static constexpr std::array<std::array<double, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

  static Parameter centre() { return {0.5, 0.5}; }
  static bool contains(const Parameter& p) { return p.x() >= 0 && p.x() <= 1 && p.y() >= 0 && p.y() <= 1; }
  /// The domain's nearest point (Euclidean; the domain is convex, so the projection brings no two points apart).
  static Parameter nearest(const Parameter& p) { return p.cwiseMax(0.0).cwiseMin(1.0); }
  /// True if a rectangle lies beyond one of the sides, given its centre and half its sides.
  static bool is_outside(const Parameter& p, const Parameter& half) {
    return ((p + half).array() < 0).any() || ((p - half).array() > 1).any();
  }
  /// True if the domain holds all of a rectangle.
  static bool contains(const Parameter& p, const Parameter& half) { return contains(p - half) && contains(p + half); }

  /// d(child parameter) / d(parent parameter): parent = origin(child) + scale(child) * child parameter.
  static double scale(int) { return 0.5; }
  static Parameter to_parent(int child, const Parameter& p) {
    return {0.5 * (p.x() + corners[static_cast<std::size_t>(child)][0]),
            0.5 * (p.y() + corners[static_cast<std::size_t>(child)][1])};
  }
  /// Exact: doubling and subtracting 1 round nothing on [1/2, 1].
  static ChildParameter to_child(const Parameter& p) {
    const bool right = p.x() >= 0.5;
    const bool upper = p.y() >= 0.5;
    return {upper ? (right ? 2 : 3) : (right ? 1 : 0), {2 * p.x() - right, 2 * p.y() - upper}};
  }
};

/// The triangle u, v >= 0, u + v <= 1. Children 0..2 hold the parent's corners and keep its orientation; child 3 is the
/// middle one, turned by half a turn: its corner 0 is the midpoint of the parent's edge 1-2.
template <>
struct Domain<FaceKind::triangle> {
  static constexpr int corner_count = 3;
  static constexpr std::array<std::array<double, 2>, 3> corners{{{0, 0}, {1, 0}, {0, 1}}};

  static Parameter centre() { return {1.0 / 3, 1.0 / 3}; }
  static bool contains(const Parameter& p) { return p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1; }
  static Parameter nearest(const Parameter& p) {
    // 1 - x is exact for x >= 1/2, x + y is not: (1, 1e-20) lies outside, and halving the domain would show it.
    if (p.y() > 1 - p.x() || p.x() > 1 - p.y()) {
      const double along = std::min(1.0, std::max(0.0, 0.5 * (1 + p.x() - p.y())));
      return {along, 1 - along};
    }
    return p.cwiseMax(0.0).cwiseMin(1.0);
  }
  static bool is_outside(const Parameter& p, const Parameter& half) {
    return ((p + half).array() < 0).any() || (p - half).sum() > 1;
  }
  static bool contains(const Parameter& p, const Parameter& half) {
    return ((p - half).array() >= 0).all() && (p + half).sum() <= 1;
  }

  static double scale(int child) { return child == 3 ? -0.5 : 0.5; }
  static Parameter to_parent(int child, const Parameter& p) {
    if (child == 3) return {0.5 * (1 - p.x()), 0.5 * (1 - p.y())};
    return {0.5 * (p.x() + corners[static_cast<std::size_t>(child)][0]),
            0.5 * (p.y() + corners[static_cast<std::size_t>(child)][1])};
  }
  static ChildParameter to_child(const Parameter& p) {
    if (p.x() >= 0.5) return {1, {2 * p.x() - 1, 2 * p.y()}};
    if (p.y() >= 0.5) return {2, {2 * p.x(), 2 * p.y() - 1}};
    if (p.x() + p.y() <= 0.5) return {0, {2 * p.x(), 2 * p.y()}};
    return {3, {1 - 2 * p.x(), 1 - 2 * p.y()}};
  }
};

/// Part of a domain: its parameters p are the domain's at origin + scale * p, coordinate by coordinate.
struct SubDomain {
  Parameter origin = Parameter::Zero();
  Parameter scale = Parameter::Ones();  ///< powers of two, both negative in a turned triangle

  Parameter operator()(const Parameter& at) const { return origin + scale.cwiseProduct(at); }
  /// A part of this part.
  SubDomain operator()(const SubDomain& part) const { return {(*this)(part.origin), scale.cwiseProduct(part.scale)}; }
  /// Halvings along the coordinate that was halved most often.
  int depth() const { return -std::ilogb(scale.cwiseAbs().minCoeff()); }
};

/// The part that is child k of a split.
template <FaceKind kind>
SubDomain child_domain(int k) {
  using D = Domain<kind>;
  return {D::to_parent(k, Parameter::Zero()), Parameter::Constant(D::scale(k))};
}

}  // namespace shaolin
