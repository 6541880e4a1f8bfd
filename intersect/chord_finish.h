#pragma once
/// The chord finish: the algorithm of Mueller et al. 2003 as published, for Loop, and for the schemes that its authors
/// left in progress.
#include "chord_search.h"
#include "plane_hull.h"
#include "valid_parts.h"

namespace shaolin {

/// A Finish of ShaoLin (see shaolin.h). Rays meet chord faces, gap polygons and border areas, never the limit surface
/// itself; nothing of the exact finish is used. Lost hits are possible within the tolerance: where the limit surface
/// leaves its chord faces by less than epsilon across the ray, or is smaller than min_size pixels. All parts of a start
/// patch that is reached are asked: one of most patches, hundreds where one is folded.
template <Scheme S>
class ChordFinish {
  using Node = ChordNode<S>;

 public:
  explicit ChordFinish(const ChordOptions& options = {}) : options_(options) {}

  /// A part of a face's patch with a plane TP of its own: all of it, unless that overlaps itself in the projection onto
  /// TP (section 8.1).
  struct Part {
    Part(const Vec3& plane_normal, bool valid, const BoxSpace& space)
        : normal(plane_normal), is_valid(valid), box({}, space) {}

    Node root;
    Vec3 normal;    ///< of TP
    bool is_valid;  ///< equation 6 holds for sure
    SceneBox box;   ///< of the limit and the border areas
  };

  class StartPatch {
   public:
    StartPatch(Patch<S> patch, int level, const BoxSpace& space, const ChordFinish& finish, TreeTotals& totals);

    const SceneBox& box() const { return scene_box_; }
    const Box& bounds() const { return box_; }
    const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }
    std::uint64_t bytes() const {
      std::uint64_t bytes = parts_.size() * (sizeof(Part) + sizeof(parts_.front()));
      for (const auto& part : parts_) bytes += part->root.own_bytes();
      return bytes;
    }
    std::uint64_t grown_bytes() const {
      std::uint64_t bytes = 0;
      for (const auto& part : parts_) bytes += part->root.bytes_below();
      return bytes;
    }

   private:
    Box box_;
    SceneBox scene_box_;
    std::vector<std::unique_ptr<Part>> parts_;
  };

  using Found = ChordHit;

  template <Query query>
  bool search(const StartPatch& start, Approach& approach, TreeTotals& totals, std::optional<Found>& found) const;

  Hit hit(const Found& found, int face, int sub, const SchemeSurface<S>&) const {
    return found.hit(face, sub, S::face_kind);
  }

 private:
  class Search;

  BorderHulls hulls() const {
    if (!options_.border_areas) return BorderHulls::none;
    return options_.stand_in_borders ? BorderHulls::stand_ins : BorderHulls::bounds;
  }

  ChordOptions options_;
};

template <Scheme S>
ChordFinish<S>::StartPatch::StartPatch(Patch<S> patch, int level, const BoxSpace& space, const ChordFinish& finish,
                                       TreeTotals& totals)
    : scene_box_({}, space) {
  using D = Domain<S::face_kind>;
  const auto add = [&](const Patch<S>& points, const std::vector<std::uint8_t>& path, const Vec3& normal, bool valid) {
    Parameter origin = Parameter::Zero();
    double scale = 1;
    for (const std::uint8_t k : path) {
      origin += scale * D::to_parent(k, Parameter::Zero());
      scale *= D::scale(k);
    }
    auto part = std::make_unique<Part>(normal, valid, space);
    part->root.make_root(std::make_unique<typename Node::Root>(
                             typename Node::Root{points, level + static_cast<int>(path.size()), origin, scale}),
                         finish.hulls());
    Box box = limit_bound(points).with_rounding();
    for (std::size_t edge = 0; edge < Node::sides && finish.options_.border_areas; ++edge)
      part->root.for_each_border_point(edge, [&](const Vec3& p) { box.add(p); });  // which may leave the bound
    part->box = SceneBox(box, space);
    box_.add(box);
    parts_.push_back(std::move(part));
  };
  if (finish.options_.valid_patches) {
    const ValidityCounts counts = for_each_valid_part(
        patch, [&](const ValidPart<S>& part) { add(part.patch, part.path, part.plane_normal, part.resolved); });
    totals.invalid_patches += counts.split;
    totals.unresolved_patches += counts.unresolved;
  } else {
    add(patch, {}, chord_plane_normal(patch), true);
  }
  scene_box_ = SceneBox(box_, space);
}

/// Section 7 along one ray.
template <Scheme S>
class ChordFinish<S>::Search : public ChordSearch<S> {
  using Base = ChordSearch<S>;
  using Base::approach_;
  using Base::error_;
  using Base::frame_;
  using Base::options_;
  using Base::totals_;
  static constexpr std::size_t sides = Node::sides;

 public:
  Search(const Part& part, const Box& bounds, const Approach& approach, const ChordOptions& options, BorderHulls hulls,
         TreeTotals& totals)
      : Base(part.normal, bounds, approach, options, hulls, totals), is_valid_(part.is_valid) {
    // The shadow's direction: across the normal of TP, within RP, along the ray.
    const Vec3 normal = frame_.turn(part.normal);
    along_y_ = normal.z();
    along_z_ = -normal.y();
    if (along_z_ < 0) along_y_ = -along_y_, along_z_ = -along_z_;
    if (along_y_ == 0 && along_z_ == 0) along_z_ = 1;
  }

  template <Query query>
  void run(const Node& root) {
    if (shadow(root)) visit<query>({&root, 0, false});
  }

 private:
  /// An element of a shadow list.
  struct Element {
    const Node* node;
    double place;    ///< where the shadow enters it, measured along the shadow
    bool is_w_case;  ///< skips the CP test and the criteria
  };

  using Corners = std::array<Vec3, sides>;
  Corners project(const Node& node) const {
    Corners corners;
    for (std::size_t k = 0; k < sides; ++k) corners[k] = frame_.project(node.corner(k).position);
    return corners;
  }

  /// The place on the shadow of a point of RP, in the frame's coordinates.
  double place(const Vec3& p) const { return along_y_ * p.y() + along_z_ * p.z(); }
  /// Where a segment crosses RP; empty if it does not. (Within the error of its coordinates it does.)
  std::optional<double> crossing(const Vec3& a, const Vec3& b) const {
    if ((a.x() > error_ && b.x() > error_) || (a.x() < -error_ && b.x() < -error_)) return {};
    const double across = b.x() - a.x();
    const double share = across == 0 ? 0.5 : std::clamp(-a.x() / across, 0.0, 1.0);
    return place(a) + share * (place(b) - place(a));
  }

  /// Shadow test: where the shadow enters a chord face, or the hull of an outer border curve; empty if nowhere.
  std::optional<double> shadow(const Node& node) const { return shadow(node, project(node)); }
  std::optional<double> shadow(const Node& node, const Corners& corners) const {
    std::optional<double> first;
    const auto enter = [&](double at) { first = first ? std::min(*first, at) : at; };
    for (std::size_t k = 0; k < sides; ++k)
      if (const std::optional<double> at = crossing(corners[k], corners[(k + 1) % sides])) enter(*at);
    if (first || !options_.border_areas) return first;
    for (std::size_t edge = 0; edge < sides; ++edge) {
      if (!node.is_outer(edge)) continue;
      // The chord lies on one side of RP, and the hull is no farther from it.
      const double way = std::min(std::abs(corners[edge].x()), std::abs(corners[(edge + 1) % sides].x()));
      if (way > node.border_reach() + 2 * error_) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low, least = low;
      node.for_each_border_point(edge, [&](const Vec3& point) {
        const Vec3 p = frame_.project(point);
        low = std::min(low, p.x());
        high = std::max(high, p.x());
        least = std::min(least, place(p));
      });
      if (low <= error_ && high >= -error_) enter(least);
    }
    return first;
  }

  /// CP test: whether the control points are on both sides of CP, and not all nearer or farther than the ray looks.
  bool crosses_cp(const Node& node) const {
    ++approach_.counters.hull_tests;
    const Box hull = this->hull(node);
    return hull.lower.y() <= error_ && hull.upper.y() >= -error_ && hull.upper.z() >= approach_.ray.near - error_ &&
           hull.lower.z() <= approach_.far() + error_;
  }

  template <Query query>
  void visit(const Element& element);
  void meet_leaf(const Node& node);
  void meet_gap(const Node& leaf, const Node& finer, std::size_t edge);
  void meet_border(const Node& node, std::size_t edge);
  std::optional<Element> w_case(const Node& node, std::size_t edge, const Vec3& from, const Vec3& middle,
                                const Vec3& to);
  bool is_reactivated(const Node& node) const {
    return std::find(reactivated_.begin(), reactivated_.end(), &node) != reactivated_.end();
  }

  bool is_valid_;
  double along_y_, along_z_;
  std::vector<const Node*> reactivated_;
};

template <Scheme S>
template <Query query>
bool ChordFinish<S>::search(const StartPatch& start, Approach& approach, TreeTotals& totals,
                            std::optional<Found>& found) const {
  bool is_found = false;
  for (const auto& part : start.parts()) {
    if (!approach.box_ray.meets(part->box, approach.box_far())) continue;
    Search search(*part, start.bounds(), approach, options_, hulls(), totals);
    search.template run<query>(part->root);
    if (!search.found) continue;
    found = search.found;
    is_found = true;
    if (query == Query::any) break;
    approach.shorten(found->distance);
  }
  return is_found;
}

/// Section 7.4. Of the elements of a shadow list the first that is hit ends the search, as far as places on the shadow
/// tell nearer from farther: an element that the shadow enters behind the hit holds no nearer one.
template <Scheme S>
template <Query query>
void ChordFinish<S>::Search::visit(const Element& element) {
  const Node& node = *element.node;
  if (!element.is_w_case) {
    if (!crosses_cp(node)) return;
    if (!this->is_refined(node)) return meet_leaf(node);
  }
  const typename Node::Children& children = this->children(node);
  std::array<Element, 4 + sides> shadow_list;
  std::size_t count = 0;
  const auto insert = [&](const Element& entered) {
    std::size_t at = count++;
    for (; at > 0 && shadow_list[at - 1].place > entered.place; --at) shadow_list[at] = shadow_list[at - 1];
    shadow_list[at] = entered;
  };
  std::array<Corners, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = project(children.nodes[k]);
    if (const std::optional<double> at = shadow(children.nodes[k], corners[k]))
      insert({&children.nodes[k], *at, false});
  }
  for (std::size_t e = 0; options_.w_cases && e < sides; ++e) {
    const std::size_t next = (e + 1) % sides;
    if (const auto neighbour = w_case(node, e, corners[e][e], corners[e][next], corners[next][next]))
      insert(*neighbour);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (this->found &&
        (query == Query::any || (is_valid_ && shadow_list[i].place > along_z_ * this->found->distance + error_)))
      return;
    visit<query>(shadow_list[i]);
  }
}

/// Section 7.2. The shadow leaves the children across one half of an edge and comes back across the other if both ends
/// lie on one side of RP and the middle on the other; the stretch between runs outside the children if the middle is
/// set in, on the parent's side of the chord as seen along the normal of TP. It belongs to the neighbour across the
/// edge, which is made if the ray has not come that deep there. Each neighbour is reactivated once a ray.
template <Scheme S>
auto ChordFinish<S>::Search::w_case(const Node& node, std::size_t edge, const Vec3& from, const Vec3& middle,
                                    const Vec3& to) -> std::optional<Element> {
  const auto side = [&](const Vec3& p) { return p.x() > error_ ? 1 : p.x() < -error_ ? -1 : 0; };
  // A middle within rounding of RP may be on the other side.
  if (side(from) * side(to) <= 0 || side(middle) == side(from)) return {};
  // Seen along the normal of TP: coordinates are the distance from RP and the place on the shadow. Whether that view
  // keeps or turns orientation follows from the face's own.
  const auto area = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x() - a.x()) * (place(c) - place(a)) - (c.x() - a.x()) * (place(b) - place(a));
  };
  const Corners own = project(node);
  double orientation = area(own[0], own[1], own[2]);
  if constexpr (sides == 4) orientation += area(own[0], own[2], own[3]);
  if (area(from, to, middle) * orientation < 0) return {};
  const auto neighbour = node.neighbour(edge, [&](const Node& coarse) { return &this->children(coarse); });
  if (!neighbour.node || is_reactivated(*neighbour.node)) return {};
  ++approach_.counters.w_cases;
  reactivated_.push_back(neighbour.node);
  return Element{neighbour.node, std::min(*crossing(from, middle), *crossing(middle, to)), true};
}

/// Section 7.3. The paper asks for a gap polygon where two leaves in a row differ in level. Leaves in a row need not be
/// neighbours (CP may have left one out between them), so a leaf is asked instead for its finer neighbours across the
/// edges that the shadow crosses; those of the coarser side are theirs to ask.
template <Scheme S>
void ChordFinish<S>::Search::meet_leaf(const Node& node) {
  if (this->meet_chord_face(node)) return;
  const Corners corners = project(node);
  for (std::size_t edge = 0; edge < sides; ++edge) {
    if (node.is_outer(edge)) {
      if (options_.border_areas) meet_border(node, edge);
      continue;
    }
    if (!options_.gap_polygons || !crossing(corners[edge], corners[(edge + 1) % sides])) continue;
    const auto neighbour = node.neighbour(edge, [&](const Node& coarse) {
      return this->is_refined(coarse) || is_reactivated(coarse) ? &this->children(coarse) : nullptr;
    });
    if (neighbour.node) meet_gap(node, *neighbour.node, neighbour.edge);
  }
}

/// The polygon between the chord of a leaf's edge and the edges of its finer neighbour, as triangles: each between an
/// edge and its two halves.
template <Scheme S>
void ChordFinish<S>::Search::meet_gap(const Node& leaf, const Node& finer, std::size_t edge) {
  if (!this->is_refined(finer) && !is_reactivated(finer)) return;
  const typename Node::Children& children = this->children(finer);
  const std::size_t next = (edge + 1) % sides;
  const Node &first = children.nodes[edge], &second = children.nodes[next];
  ++approach_.counters.gap_polygons;
  if (this->meet(leaf, {this->point(finer, edge), this->point(first, next), this->point(finer, next)}, true))
    ++approach_.counters.gap_polygons_hit;
  const Vec3 from = frame_.project(finer.corner(edge).position), to = frame_.project(finer.corner(next).position);
  const Vec3 middle = frame_.project(children.middles[edge].position);
  if (crossing(from, middle)) meet_gap(leaf, first, edge);
  if (crossing(middle, to)) meet_gap(leaf, second, edge);
}

/// Section 7.3: the ray meets the border area if it passes through the hull of the border curve, seen along the ray.
/// The paper does not say where; here, as far along the ray as the nearest point of the chord.
template <Scheme S>
void ChordFinish<S>::Search::meet_border(const Node& node, std::size_t edge) {
  const std::size_t next = (edge + 1) % sides;
  const ChordCorner &a = node.corner(edge), &b = node.corner(next);
  const Vec3 from = frame_.project(a.position), chord = frame_.project(b.position) - from;
  const double square = chord.head<2>().squaredNorm();
  const double share = square > 0 ? std::clamp(-from.head<2>().dot(chord.head<2>()) / square, 0.0, 1.0) : 0.5;
  if ((from + share * chord).head<2>().norm() > node.border_reach() + 4 * error_) return;
  OriginInHull hull(error_);
  node.for_each_border_point(edge, [&](const Vec3& point) {
    const Vec3 p = frame_.project(point);
    hull.add(p.x(), p.y());
  });
  if (!hull.holds()) return;
  const double distance = from.z() + share * chord.z();
  if (!this->is_nearer(distance)) return;
  ++approach_.counters.border_areas_hit;
  this->take(
      {distance, approach_.ray.origin + distance * approach_.ray.direction, (1 - share) * a.normal + share * b.normal,
       (1 - share) * node.corner_parameter(edge) + share * node.corner_parameter(next), node.level()},
      node.normal());
}

}  // namespace shaolin
