#include "pair_search.h"

#include "nearest_queue.h"
#include "separation.h"

namespace shaolin {

namespace {

Parameter centre_of(const SurfaceCell& cell) {
  return cell.is_triangular() ? Domain<FaceKind::triangle>::centre() : Domain<FaceKind::quad>::centre();
}

Parameter inside_of(const SurfaceCell& cell, const Parameter& at) {
  return cell.is_triangular() ? Domain<FaceKind::triangle>::nearest(at) : Domain<FaceKind::quad>::nearest(at);
}

/// Of a corner without derivatives, none: it stays.
Eigen::Matrix<double, 3, 2> slopes_of(const FramedSample& place) {
  Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
  if (place.derivatives) slopes << place.derivatives->du, place.derivatives->dv;
  return slopes;
}

/// A place in a cell's domain that steps move, up to the domain's sides and along them.
class Walk {
 public:
  Walk(const SurfaceCell& cell, const Parameter& from) : at_(from), sides_{{{-1, 0}, 0}, {{0, -1}, 0}} {
    if (cell.is_triangular()) {
      sides_.push_back({Parameter(1, 1).normalized(), std::sqrt(0.5)});
    } else {
      sides_.insert(sides_.end(), {{{1, 0}, 1}, {{0, 1}, 1}});
    }
  }

  const Parameter& at() const { return at_; }
  /// Onto the directions that are left.
  const Eigen::Matrix2d& projection() const { return projection_; }

  /// The share of a step, up to 1, that stays inside.
  double room(const Parameter& step) const {
    double share = 1;
    for (const Side& side : sides_) share = std::min(share, side.room(at_, step));
    return share;
  }

  /// Goes a share of a step. What sides are reached confines all further steps.
  void go(const Parameter& step, double share) {
    for (auto side = sides_.begin(); side != sides_.end();) {
      if (side->room(at_, step) > share) {
        ++side;
        continue;
      }
      projection_ -=
          projection_.isIdentity(0) ? Eigen::Matrix2d(side->outwards * side->outwards.transpose()) : projection_;
      side = sides_.erase(side);
    }
    at_ += share * step;
  }

 private:
  /// Inside, outwards . p is offset or less.
  struct Side {
    Parameter outwards;
    double offset;

    double room(const Parameter& at, const Parameter& step) const {
      const double speed = outwards.dot(step);
      return speed > 0 ? std::max(0.0, offset - outwards.dot(at)) / speed : std::numeric_limits<double>::infinity();
    }
  };

  Parameter at_;
  Eigen::Matrix2d projection_ = Eigen::Matrix2d::Identity();
  std::vector<Side> sides_;
};

}  // namespace

auto PairSearch::run(SurfaceCell& a, SurfaceCell& b) -> std::optional<Found> {
  NearestQueue<Pair> queue;
  const auto add = [&](const Pair& pair) {
    if (const std::optional<double> rank = look(pair)) queue.push(static_cast<float>(*rank), pair);
  };
  add({&a, &b});
  while (!queue.empty() && !found_) {
    const Pair pair = queue.pop();
    const bool splits_a = a_.extent(*pair.a) >= b_.extent(*pair.b);
    for (const auto& part : (splits_a ? pair.a : pair.b)->parts()) {
      if (found_) break;
      add(splits_a ? Pair{part.get(), pair.b} : Pair{pair.a, part.get()});
    }
  }
  return found_;
}

bool PairSearch::is_apart(const Pair& pair, const Vec3& way) const {
  const auto lowest = [&](const Vec3& n) -> Vec3 {
    ++counters_.hull_tests;
    return a_.supporting_point(*pair.a, n) - b_.supporting_point(*pair.b, -n);
  };
  return are_separable(lowest, way, error_);
}

std::optional<double> PairSearch::look(const Pair& pair) {
  ++counters_.cells;
  std::optional<FramedSample> a = a_.sample(*pair.a, centre_of(*pair.a)), b = b_.sample(*pair.b, centre_of(*pair.b));
  const Vec3 middle_a = a ? a->position : a_(pair.a->box().centre()),
             middle_b = b ? b->position : b_(pair.b->box().centre()), way = middle_a - middle_b;
  if (is_apart(pair, way)) return {};
  if (!a || !b) return way.norm();
  const bool are_points = std::max(a_.extent(*pair.a), b_.extent(*pair.b)) <= error_;
  if (are_points || approach(pair, *a, *b)) {
    found_ = Found{pair.a, pair.b, *a, *b};
    return {};
  }
  if (is_apart(pair, a->position - b->position)) return {};
  return (a->position - b->position).norm();
}

bool PairSearch::approach(const Pair& pair, FramedSample& a, FramedSample& b) const {
  constexpr int most_steps = 10;
  const double near = 2 * error_;
  for (int i = 0; i < most_steps; ++i) {
    const Vec3 way = a.position - b.position;
    if (way.norm() <= near) return true;
    if (!a.derivatives && !b.derivatives) return false;
    ++counters_.newton_steps;
    Walk to_a(*pair.a, a.own.at), to_b(*pair.b, b.own.at);
    Vec3 rest = way;
    for (double share = 0; share < 1;) {
      Eigen::Matrix<double, 3, 4> slopes;
      slopes << slopes_of(a) * to_a.projection(), -slopes_of(b) * to_b.projection();
      // Where the two tangent planes are one, way has a part that no step makes up for: as small a share of the trace
      // as rounding leaves undecided keeps the steps finite.
      Eigen::Matrix3d gram = slopes * slopes.transpose();
      gram.diagonal().array() += 0x1p-40 * gram.trace();
      const Eigen::Vector4d step = -slopes.transpose() * (gram.inverse() * rest);
      if (!step.allFinite()) break;
      share = std::min(to_a.room(step.head<2>()), to_b.room(step.tail<2>()));
      to_a.go(step.head<2>(), share);
      to_b.go(step.tail<2>(), share);
      rest += share * slopes * step;
    }
    const FramedSample next_a = *a_.sample(*pair.a, inside_of(*pair.a, to_a.at())),
                       next_b = *b_.sample(*pair.b, inside_of(*pair.b, to_b.at()));
    const double distance = (next_a.position - next_b.position).norm();
    if (!(distance < way.norm())) return false;
    const bool is_slow = distance > 0.5 * way.norm();
    a = next_a;
    b = next_b;
    if (is_slow && distance > near) return false;
  }
  return (a.position - b.position).norm() <= near;
}

}  // namespace shaolin
