#include "pair_search.h"

#include "nearest_queue.h"

namespace shaolin {

namespace {

Parameter centre_of(const SurfaceCell& cell) {
  return cell.is_triangular() ? Domain<FaceKind::triangle>::centre() : Domain<FaceKind::quad>::centre();
}

Parameter inside_of(const SurfaceCell& cell, const Parameter& at) {
  return cell.is_triangular() ? Domain<FaceKind::triangle>::nearest(at) : Domain<FaceKind::quad>::nearest(at);
}

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

/// True if a plane across the way from b to a has all of b behind it and all of a before it.
bool PairSearch::is_apart(const Pair& pair, const Vec3& way) const {
  const double length = way.norm();
  if (!(length > 0)) return false;
  ++counters_.hull_tests;
  const Vec3 n = way / length;
  return a_.low(*pair.a, n) + b_.low(*pair.b, -n) > error_;
}

bool PairSearch::is_apart_along_sides(const Pair& pair) const {
  for (const CellFrame* frame : {&a_, &b_})
    for (const Vec3& side : frame->sides())
      if (is_apart(pair, side) || is_apart(pair, -side)) return true;
  return false;
}

std::optional<double> PairSearch::look(const Pair& pair) {
  ++counters_.cells;
  std::optional<FramedSample> a = a_.sample(*pair.a, centre_of(*pair.a)), b = b_.sample(*pair.b, centre_of(*pair.b));
  const Vec3 middle_a = a ? a->position : a_(pair.a->box().centre()),
             middle_b = b ? b->position : b_(pair.b->box().centre()), way = middle_a - middle_b;
  if (is_apart(pair, way)) return {};
  if ((!a || !b) && is_apart_along_sides(pair)) return {};
  for (const auto& one : {a, b}) {
    if (!one || !one->derivatives) continue;
    const Vec3 normal = one->derivatives->du.cross(one->derivatives->dv);
    if (is_apart(pair, normal) || is_apart(pair, -normal)) return {};
  }
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
    if (!a.derivatives || !b.derivatives) return false;
    ++counters_.newton_steps;
    Eigen::Matrix<double, 3, 4> slopes;
    slopes << a.derivatives->du, a.derivatives->dv, -b.derivatives->du, -b.derivatives->dv;
    // Where the two tangent planes are one, way has a part that no step makes up for: as small a share of the trace as
    // rounding leaves undecided keeps the steps finite.
    Eigen::Matrix3d gram = slopes * slopes.transpose();
    gram.diagonal().array() += 0x1p-40 * gram.trace();
    const Eigen::Vector4d change = -slopes.transpose() * (gram.inverse() * way);
    if (!change.allFinite()) return false;
    const FramedSample next_a = *a_.sample(*pair.a, inside_of(*pair.a, a.own.at + change.head<2>())),
                       next_b = *b_.sample(*pair.b, inside_of(*pair.b, b.own.at + change.tail<2>()));
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
