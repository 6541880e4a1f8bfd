#pragma once
/// What ChordFinish and A3Finish have in common: start patches with their trees, the criteria that end refinement, and
/// the ray's test of chord faces.
#include <optional>
#include <vector>

#include "approach.h"
#include "chord_options.h"
#include "chord_plane.h"
#include "chord_tree.h"
#include "ray_frame.h"
#include "triangle.h"

namespace shaolin {

/// Where a ray meets chord faces: positions and normals are interpolated from the corners' limits (but see
/// ChordSearch::take()).
struct ChordHit {
  double distance;
  Vec3 position;
  Vec3 normal;   ///< unit
  Parameter at;  ///< in the face's patch
  int level;     ///< of the leaf

  Hit hit(int face, int sub, FaceKind kind) const {
    const Parameter inside =
        kind == FaceKind::triangle ? Domain<FaceKind::triangle>::nearest(at) : Domain<FaceKind::quad>::nearest(at);
    Hit hit;
    hit.at = {face, sub, inside.x(), inside.y()};
    hit.level = level;
    hit.sample = {position, normal, {}};
    return hit;
  }
};

/// A corner of a chord face: corner k of a subpatch.
template <Scheme S>
struct ChordPoint {
  const ChordNode<S>* node;
  std::size_t k;

  const ChordCorner& operator*() const { return node->corner(k); }
  const ChordCorner* operator->() const { return &node->corner(k); }
  Parameter at() const { return node->corner_parameter(k); }
};

/// A ray on its way through a part of a start patch.
template <Scheme S>
class ChordSearch {
 public:
  using Node = ChordNode<S>;
  static constexpr std::size_t sides = Node::sides;

  ChordSearch(const Vec3& plane_normal, const Box& bounds, const Approach& approach, const ChordOptions& options,
              BorderHulls hulls, TreeTotals& totals)
      : approach_(approach),
        frame_(approach.ray, plane_normal),
        triangle_ray_(approach.ray),
        error_(RayFrame::error(approach.ray.origin, bounds)),
        options_(options),
        hulls_(hulls),
        totals_(totals) {}

  std::optional<ChordHit> found;

 protected:
  /// The criteria of section 7.1, combined as there; a function of the ray and the patch alone. Where pixels set no
  /// least size (the ray has no footprint, or min_size is 0) a patch whose chords are all shorter than epsilon is a
  /// leaf: what it hides is no larger, and a flat part seen edge-on would be refined along all of the ray. Whatever the
  /// options, most_splits bounds the work: 2^-24 of a start patch is less than any picture shows. Each time that this
  /// bound decides is counted.
  bool is_refined(const Node& node) const {
    constexpr int most_splits = 24;
    const Footprint& footprint = approach_.footprint;
    const double epsilon = options_.epsilon * footprint.unit;
    const bool knows_pixels = footprint.width > 0 || footprint.growth > 0;
    if (knows_pixels) {
      const double size = projected_size(node), pixel = std::max(0.0, footprint.at(distance(node)));
      if (size < options_.min_size * pixel) return false;
      if (size > options_.max_size * pixel) return node.splits() < most_splits || is_too_deep();
    }
    if ((!knows_pixels || options_.min_size == 0) && node.longest_chord() < epsilon) return false;
    if (node.splits() >= most_splits) return is_too_deep();
    const double silhouette = std::abs(node.normal().dot(approach_.ray.direction));
    return !(node.deviation(options_.end_normals) <= epsilon * silhouette);
  }

  const typename Node::Children& children(const Node& node) const { return node.children(hulls_, totals_); }

  /// What the limit of a subpatch lies in, in the frame's coordinates.
  Box hull(const Node& node) const {
    Box box;
    for (std::size_t i = 0; i < node.point_count(); ++i) box.add(frame_.project(node.point(i)));
    return box.expanded(node.configuration().hull_expansion());
  }

  /// Meets the chord face: a triangle, or a quad as two on its limit points.
  bool meet_chord_face(const Node& node) {
    ++approach_.counters.chord_tests;
    bool is_met = meet(node, {point(node, 0), point(node, 1), point(node, 2)});
    if constexpr (sides == 4) is_met |= meet(node, {point(node, 0), point(node, 2), point(node, 3)});
    return is_met;
  }

  using Point = ChordPoint<S>;
  static Point point(const Node& node, std::size_t k) { return {&node, k}; }

  /// Takes the point where the ray meets a triangle, if it is the nearest so far: of a leaf's chord face, or of a gap
  /// polygon beside it.
  bool meet(const Node& leaf, const std::array<Point, 3>& corners, bool is_gap = false) {
    const auto meeting = triangle_ray_.meet(corners[0]->position, corners[1]->position, corners[2]->position,
                                            approach_.ray.near, approach_.far());
    if (!meeting || !is_nearer(meeting->distance)) return false;
    ChordHit hit{meeting->distance, Vec3::Zero(), Vec3::Zero(), Parameter::Zero(), leaf.level()};
    for (std::size_t i = 0; i < 3; ++i) {
      hit.position += meeting->weights[i] * corners[i]->position;
      hit.normal += meeting->weights[i] * corners[i]->normal;
      hit.at += meeting->weights[i] * corners[i].at();
    }
    const Vec3& a = corners[0]->position;
    const Vec3 flat = (corners[1]->position - a).cross(corners[2]->position - a);
    take(hit, is_gap ? leaf.normal() : flat);
    return true;
  }

  /// Within the ray's interval, and before the nearest hit so far: of equal ones the first stays.
  bool is_nearer(double distance) const {
    return distance >= approach_.ray.near &&
           (approach_.far_is_hit() ? distance < approach_.far() : distance <= approach_.far());
  }

  /// Takes a hit on a chord face, or beside one, where a gap polygon or a border area is met; these are slivers that
  /// face any way, so the side from which the ray comes is that of the leaf's chord face. Along outlines, and beside
  /// creases narrower than the leaf, a face can look at the ray whose interpolated normal looks away: faces turn by
  /// leaps, normals gradually. Who shades the side that is seen would turn such a normal round, into the body. There,
  /// as where corners have no normals, the face's own stands in; so a normal looks at the ray where the face does, and
  /// away where that does.
  void take(ChordHit hit, const Vec3& face_normal) {
    const Vec3& direction = approach_.ray.direction;
    if (hit.normal.isZero(0) || hit.normal.dot(direction) * face_normal.dot(direction) < 0) hit.normal = face_normal;
    hit.normal = hit.normal.stableNormalized();
    found = hit;
    approach_.shorten(hit.distance);
  }

  Approach approach_;
  RayFrame frame_;
  TriangleRay triangle_ray_;
  double error_;  ///< of coordinates in the frame
  const ChordOptions& options_;
  BorderHulls hulls_;
  TreeTotals& totals_;

 private:
  bool is_too_deep() const {
    ++approach_.counters.depth_bounds;
    return false;
  }

  /// The length of the longest chord, seen along the ray.
  double projected_size(const Node& node) const {
    return node.longest_chord([&](const Vec3& chord) -> Vec3 { return chord.cross(approach_.ray.direction); });
  }

  /// Of the chord face's centre along the ray.
  double distance(const Node& node) const {
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < sides; ++k) centre += node.corner(k).position / sides;
    return approach_.ray.direction.dot(centre - approach_.ray.origin);
  }
};

}  // namespace shaolin
