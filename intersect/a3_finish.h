#pragma once
/// The baseline A3 of Mueller et al. 2003, section 9: Woodward's approach as the paper describes it.
#include "chord_search.h"
#include "plane_hull.h"

namespace shaolin {

/// A Finish of ShaoLin (see shaolin.h): the control points N(F) of a subpatch are projected onto the plane across the
/// ray; if the ray's point is in their hull, the subpatch is refined by the criteria that ChordFinish has, with the
/// same cached control and limit points, or its chord face is met. Between leaves of different levels there are cracks.
template <Scheme S>
class A3Finish {
  using Node = ChordNode<S>;

 public:
  explicit A3Finish(const ChordOptions& options = {}) : options_(options) {}

  class StartPatch {
   public:
    StartPatch(Patch<S> patch, int level, const BoxSpace& space, const A3Finish&, TreeTotals&)
        : box_(limit_bound(patch).with_rounding()), scene_box_(box_, space) {
      root_.make_root(std::make_unique<typename Node::Root>(typename Node::Root{std::move(patch), level}),
                      BorderHulls::none);
    }
    const SceneBox& box() const { return scene_box_; }
    const Box& bounds() const { return box_; }
    const Node& root() const { return root_; }
    std::uint64_t bytes() const { return root_.own_bytes(); }
    std::uint64_t grown_bytes() const { return root_.bytes_below(); }

   private:
    Box box_;
    SceneBox scene_box_;
    Node root_;
  };

  using Found = ChordHit;

  template <Query query>
  bool search(const StartPatch& start, const Approach& approach, TreeTotals& totals,
              std::optional<Found>& found) const {
    // Any plane along the ray will do: the projection across the ray is what counts.
    Search search(start.root().normal(), start.bounds(), approach, options_, BorderHulls::none, totals);
    search.template visit<query>(start.root());
    if (search.found) found = search.found;
    return search.found.has_value();
  }

  Hit hit(const Found& found, int face, int sub, const SchemeSurface<S>&) const {
    return found.hit(face, sub, S::face_kind);
  }

 private:
  class Search : public ChordSearch<S> {
    using Base = ChordSearch<S>;
    using Base::approach_;
    using Base::error_;
    using Base::frame_;

   public:
    using Base::Base;

    template <Query query>
    void visit(const Node& node) {
      if (!holds_ray(node)) return;
      if (!this->is_refined(node)) {
        this->meet_chord_face(node);
        return;
      }
      struct Entry {
        const Node* node;
        double distance;
      };
      std::array<Entry, 4> order;
      for (std::size_t k = 0; k < 4; ++k) {
        const Node& child = this->children(node).nodes[k];
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < Node::sides; ++i) sum += child.corner(i).position;
        order[k] = {&child, sum.dot(approach_.ray.direction)};
      }
      std::sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) { return a.distance < b.distance; });
      for (const Entry& entry : order) {
        visit<query>(*entry.node);
        if (query == Query::any && this->found) return;
      }
    }

   private:
    bool holds_ray(const Node& node) const {
      ++approach_.counters.hull_tests;
      const double expansion = node.configuration().hull_expansion();
      const bool is_hull = expansion == 0;
      // As published: without a margin for rounding, which would take four points for each. Neighbours' hulls overlap.
      OriginInHull hull(is_hull ? 0 : error_);
      double low = std::numeric_limits<double>::infinity(), high = -low;
      const auto add = [&](const Vec3& p) {
        hull.add(p.x(), p.y());
        low = std::min(low, p.z());
        high = std::max(high, p.z());
      };
      if (is_hull) {
        for (std::size_t i = 0; i < node.point_count(); ++i) add(frame_.project(node.point(i)));
      } else {  // the limit leaves the hull of its control points: the box that holds it instead
        const Box box = this->hull(node);
        for (const double x : {box.lower.x(), box.upper.x()})
          for (const double y : {box.lower.y(), box.upper.y()}) hull.add(x, y);
        low = box.lower.z();
        high = box.upper.z();
      }
      return hull.holds() && high >= approach_.ray.near - error_ && low <= approach_.far() + error_;
    }
  };

  ChordOptions options_;
};

}  // namespace shaolin
