#pragma once
/// The first point of a polynomial patch on a ray, by subdivision and Newton steps in double precision.
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#include "../schemes/bezier_quad.h"
#include "../schemes/domain.h"
#include "contraction.h"
#include "counters.h"
#include "flatten.h"
#include "net.h"
#include "net_evaluation.h"

namespace shaolin {

/// A point of a patch on the ray: its parameter in the patch and its distance along the ray.
struct PatchHit {
  Parameter at;
  double distance = std::numeric_limits<double>::infinity();
  double reach = 0;        ///< how far the piece of surface that it stands for goes along the ray
  bool is_proven = false;  ///< to be the only one of its cell
  /// Of either parameter: the zero of the exact map is proven to be no farther. It may lie beyond the patch's sides,
  /// where its polynomial goes on. Infinite if nothing is proven.
  Parameter radius = nothing_proven();

  static Parameter nothing_proven() { return Parameter::Constant(std::numeric_limits<double>::infinity()); }
};

/// Finds the nearest zero of (x, y) with z in [near, far] on a Bezier patch given in a ray's frame (x, y: distances
/// from RP and CP, z: distance along the ray).
///
/// A cell of the parameter domain is dropped only on proof: its hull lies to one side of the ray, also in coordinates
/// in which the cell is nearly a unit square, or it lies beyond the nearest hit so far. Where the map (x, y) is proven
/// one to one on the cell, Newton steps projected into the cell find the zero or prove that there is none; elsewhere
/// the cell is split into four, nearest first. Points within `error` of the ray count as on it: coordinates carry that
/// much rounding. So of two patches that share an edge, at least one reports a ray that passes through the edge.
template <class Bezier>
class NewtonFinish {
 public:
  /// `far_is_hit` says that `far` is the distance of a hit found elsewhere; a hit here must then be nearer by more than
  /// the error to count. (Where a surface runs along a ray there is otherwise no end of equally near ones.)
  /// Of all hits, `cells` is how many cells the search has looked at in pieces before this one: patience is one for
  /// all.
  NewtonFinish(double error, double near, double far, bool far_is_hit, RayCounters& counters, int cells = 0)
      : error_(error), near_(near), has_hit_(far_is_hit), counters_(counters), cells_(cells) {
    best_.distance = far;
  }

  /// True if a hit was found; then hit() is the nearest.
  bool solve(const Net& patch) {
    visit(patch, Parameter::Zero(), Parameter::Ones());
    return found_;
  }
  const PatchHit& hit() const { return best_; }
  /// From now on a hit is found once it is proven to be there: where it is, is known to its radius only.
  void settle_for_any() { any_ = true; }
  /// Looked at so far, those of pieces before included.
  int cells() const { return cells_; }

  /// Appends all hits. Cells that meet at one may each report it, and of a curve of contact every part is one.
  void solve(const Net& patch, std::vector<PatchHit>& hits) {
    all_ = &hits;
    own_first_ = hits.size();
    solve(patch);
  }

 private:
  using D = typename Bezier::DomainType;
  using Matrix = Eigen::Matrix2d;

  /// Cells this small are points: halving further changes no double in [1/2, 1].
  static constexpr double smallest = 0x1p-52;
  /// A ray that runs within a surface, or along a fold, meets it in a curve; the cells around a curve are without
  /// number. Past this many, cells count as points once they are below 1e-12 of the patch, and after each as many again
  /// a hit must be nearer by twice as much to count, up to 16 times the error.
  static constexpr int patience = 512;
  static constexpr double smallest_out_of_patience = 0x1p-42;
  /// Of all hits none ends the search for others. There the size at which a cell counts as a point grows by 2^6
  /// whenever the number of cells has doubled, so that 2^15 cells end it in any case: of a start patch, for around an
  /// irregular corner a tangent ray runs along the pieces of some 25 levels.
  double smallest_now() const {
    if (cells_ <= patience) return smallest;
    return all_ ? std::ldexp(smallest_out_of_patience, 6 * std::ilogb(cells_ / patience)) : smallest_out_of_patience;
  }
  /// Slopes against the ray count up to here: a steeper cell is looked into, though its distances are less certain. It
  /// may lie beside straight lines along the ray, whose near end is to be found.
  static constexpr double steepest = 1e4;

  /// What control points weigh at the domain's centre.
  static inline const std::array<double, 16> centre_weights = Bezier::weights(D::centre()).value;

  enum class Verdict { none, found, unknown };

  /// A cell's parameters p stand for origin + scale * p, per coordinate.
  void visit(const Net& cell, const Parameter& origin, const Parameter& scale);
  void split(const Net& cell, const Parameter& origin, const Parameter& scale);
  int long_axis(const Net& cell, const Parameter& scale) const;
  bool in_band(const Range& x, const Range& y) const {
    return std::max({x.high, -x.low, y.high, -y.low}) <= 2 * error_;
  }
  static Eigen::Vector2d slope(const Net& cell);
  static Range on_ray(const Net& cell, const Eigen::Vector2d& ab);
  bool is_no_nearer(const Net& cell) const;
  bool is_known(const Net& cell) const;
  bool meets_as_a_whole(const Net& cell, const Parameter& origin, const Parameter& scale);
  Verdict newton(const Net& cell, const Matrix& flattening, const Contraction& contraction, Parameter at,
                 PatchHit& hit);
  bool holds_zero(const Net& cell, const Matrix& flattening, const Contraction& contraction, const Eigen::Vector2d& g,
                  PatchHit& hit) const;
  /// By how much a point within the error of the ray moves g = flattening * f.
  Parameter moved(const Matrix& flattening) const { return error_ * flattening.cwiseAbs().rowwise().sum(); }
  /// Of a hit in a cell's parameters.
  void accept(const PatchHit& hit, const Parameter& origin, const Parameter& scale);

  double impatience() const { return std::exp2(std::min(4, cells_ / patience)); }

  /// The distance past which nothing is of interest.
  double horizon() const { return best_.distance + (has_hit_ ? -impatience() * error_ : error_); }

  double error_;
  double near_;
  bool has_hit_;  ///< best_.distance is that of a hit
  RayCounters& counters_;
  PatchHit best_;
  bool any_ = false;                      ///< see settle_for_any()
  std::vector<PatchHit>* all_ = nullptr;  ///< where hits go if all are asked for
  std::size_t own_first_ = 0;             ///< of them, the first of this patch
  bool found_ = false;
  int cells_;
};

template <class Bezier>
void NewtonFinish<Bezier>::accept(const PatchHit& hit, const Parameter& origin, const Parameter& scale) {
  // A hit counts as within the interval if rounding alone could have moved it out.
  if (hit.distance < near_ - error_ || hit.distance > horizon()) return;
  PatchHit own = hit;
  own.at = origin + scale.cwiseProduct(hit.at);
  own.radius = scale.cwiseAbs().cwiseProduct(hit.radius);
  if (all_) return all_->push_back(own);
  best_ = own;
  found_ = has_hit_ = true;
}

template <class Bezier>
SHAOLIN_FLATTEN void NewtonFinish<Bezier>::visit(const Net& cell, const Parameter& origin, const Parameter& scale) {
  ++counters_.cells;
  ++cells_;
  const Range x(cell.x);
  if (x.low > error_ || x.high < -error_) return;
  const Range y(cell.y);
  if (y.low > error_ || y.high < -error_) return;
  const Range z(cell.z);
  if (z.high < near_ - error_ || z.low > horizon()) return;

  // A cell that touches the ray's band of error and reaches no farther than twice its width is a point, too: splitting
  // it would only trace the band's edge. (Along the ray it must be short, or it is a curve that runs along the ray.)
  const bool is_point = in_band(x, y) && z.high - z.low <= 16 * error_;
  const double size = scale.cwiseAbs().maxCoeff();
  if (is_point || size <= smallest_now()) {
    const double distance = dot(cell.z, centre_weights);
    accept({D::centre(), std::max(distance, near_), z.high - z.low}, origin, scale);
    return;
  }

  if (!all_ && cells_ > patience && in_band(x, y) && meets_as_a_whole(cell, origin, scale)) return;

  Matrix jacobian;
  jacobian << Bezier::mean_du(cell.x), Bezier::mean_dv(cell.x), Bezier::mean_du(cell.y), Bezier::mean_dv(cell.y);
  if (cells_ > 4 && (all_ ? is_known(cell) : has_hit_ && is_no_nearer(cell))) return;
  const double along_u_length = jacobian.col(0).lpNorm<1>(), along_v_length = jacobian.col(1).lpNorm<1>();
  if (std::abs(jacobian.determinant()) <= 1e-12 * along_u_length * along_v_length) {
    // Seen from the ray the cell is nearly a curve: the hull test across it.
    const Eigen::Vector2d along = jacobian.col(along_u_length > along_v_length ? 0 : 1);
    std::array<double, 16> across;
    combine(-along.y(), cell.x, along.x(), cell.y, across);
    const Range distance(across);
    const double slack = error_ * along.cwiseAbs().sum() * (1 + 1e-10);
    if (distance.low > slack || distance.high < -slack) return;
    return split(cell, origin, scale);
  }
  const Matrix flattening = jacobian.inverse();

  // The hull test again, along the cell's own axes.
  std::array<double, 16> flat_x, flat_y;
  const double slack_x = error_ * (std::abs(flattening(0, 0)) + std::abs(flattening(0, 1))) * (1 + 1e-10);
  combine(flattening(0, 0), cell.x, flattening(0, 1), cell.y, flat_x);
  const Range along_u(flat_x);
  if (along_u.low > slack_x || along_u.high < -slack_x) return;
  const double slack_y = error_ * (std::abs(flattening(1, 0)) + std::abs(flattening(1, 1))) * (1 + 1e-10);
  combine(flattening(1, 0), cell.x, flattening(1, 1), cell.y, flat_y);
  const Range along_v(flat_y);
  if (along_v.low > slack_y || along_v.high < -slack_y) return;

  // Where the error is not small against the cell, seen from the ray, there is no one zero for Newton's method to find.
  const Contraction contracts = contraction<Bezier>(flat_x, flat_y);
  if (contracts.share < 0.95 && error_ * flattening.norm() < 0.25) {
    PatchHit hit;
    const Eigen::Vector2d g(dot(flat_x, centre_weights), dot(flat_y, centre_weights));
    if (any_ && z.low >= near_ && z.high <= best_.distance && holds_zero(cell, flattening, contracts, g, hit))
      return accept(hit, origin, scale);
    const Verdict verdict = newton(cell, flattening, contracts, D::nearest(D::centre() - g), hit);
    if (verdict == Verdict::found) accept(hit, origin, scale);
    if (verdict != Verdict::unknown) return;
  }
  split(cell, origin, scale);
}

/// Factors (a, b) that take the mean slope of z away, as far as x and y can: on the ray, z is z - a x - b y for any
/// two, give or take (|a| + |b|) error. A patch collapsed to a curve meets the ray in one point over and over, at one
/// distance that the z of its cells do not show.
template <class Bezier>
Eigen::Vector2d NewtonFinish<Bezier>::slope(const Net& cell) {
  Matrix jacobian;
  jacobian << Bezier::mean_du(cell.x), Bezier::mean_dv(cell.x), Bezier::mean_du(cell.y), Bezier::mean_dv(cell.y);
  const Eigen::Vector2d mean(Bezier::mean_du(cell.z), Bezier::mean_dv(cell.z));
  // Past this ratio of what the cell's shadow measures along and across, the direction across is taken for rounding.
  // (By the normal equations, which square the ratio, four digits would be left of (a, b), and of a patch collapsed to
  // a segment that crosses the ray 4e7 cells would pass for nearer than its point on the ray.)
  constexpr double flattest = 1e-6;
  Eigen::Vector2d ab;
  if (std::abs(jacobian.determinant()) > flattest * jacobian.squaredNorm()) {
    ab = jacobian.transpose().inverse() * mean;
  } else {
    const bool u_is_longer = jacobian.col(0).squaredNorm() > jacobian.col(1).squaredNorm();
    const Eigen::Vector2d along = jacobian.col(u_is_longer ? 0 : 1).normalized();
    const Eigen::Vector2d steps = jacobian.transpose() * along;
    ab = along * (steps.dot(mean) / steps.squaredNorm());
  }
  return ab.allFinite() ? ab : Eigen::Vector2d::Zero();
}

/// The values of z - a x - b y.
template <class Bezier>
Range NewtonFinish<Bezier>::on_ray(const Net& cell, const Eigen::Vector2d& ab) {
  std::array<double, 16> plane, rest;
  combine(ab.x(), cell.x, ab.y(), cell.y, plane);
  combine(1, cell.z, -1, plane, rest);
  return Range(rest);
}

/// True if no point of the cell that lies on the ray is nearer than the hit at hand by more than its own uncertainty:
/// along a grazing ray, distances are uncertain by as much as a and b are large. So a hit may be dropped that is nearer
/// by up to impatience x error (1 + steepest): 1e4 errors, 16 times that for rays that ask thousands of cells. (Of a
/// steeper cell z - a x - b y says little about points within the error of the ray: z itself does.)
template <class Bezier>
bool NewtonFinish<Bezier>::is_no_nearer(const Net& cell) const {
  Eigen::Vector2d ab = slope(cell);
  if (ab.cwiseAbs().sum() > steepest) ab.setZero();
  const double uncertainty = impatience() * error_ * (1 + ab.cwiseAbs().sum());
  return on_ray(cell, ab).low > best_.distance - uncertainty;
}

/// Of all hits: true if a point of the cell that lies on the ray is one that is known, to within what rounding leaves
/// uncertain. Where u and v run along one curve, as at a crease's end between two of its edges, cells without number
/// hold the same point. Cells seen edge-on have no such point: they are looked into. Nor do they share one with a hit
/// that is proven, which has its cell to itself.
template <class Bezier>
bool NewtonFinish<Bezier>::is_known(const Net& cell) const {
  const std::size_t count = all_->size(), first = std::max(own_first_, count - std::min<std::size_t>(count, 8));
  if (first == count) return false;
  const Eigen::Vector2d ab = slope(cell);
  if (ab.cwiseAbs().sum() > steepest) return false;
  const double room = 16 * error_ * (1 + ab.cwiseAbs().sum());
  const Range range = on_ray(cell, ab);
  return std::any_of(all_->begin() + static_cast<std::ptrdiff_t>(first), all_->end(), [&](const PatchHit& hit) {
    return !hit.is_proven && range.low >= hit.distance - room && range.high <= hit.distance + room;
  });
}

/// Out of patience, of a cell that lies on the ray as a whole: takes where the ray starts in it, or its nearest corner,
/// for a hit, and returns true if no point of it is nearer by more than half an error. For a corner that is so if z
/// goes one way along u, along v and, of a triangle, along its third side, where differences below 1/32 of the error
/// count as none: z falls by as much a control point at most, four along each of two ways. (Of a patch collapsed to a
/// curve that a ray runs along, cells are few around the places where z turns back; for all others to be small enough
/// to be points they would have to be millions.)
template <class Bezier>
bool NewtonFinish<Bezier>::meets_as_a_whole(const Net& cell, const Parameter& origin, const Parameter& scale) {
  std::size_t first = 0, last = 0;
  for (std::size_t k = 1; k < Bezier::corners.size(); ++k) {
    if (cell.z[Bezier::corners[k]] < cell.z[Bezier::corners[first]]) first = k;
    if (cell.z[Bezier::corners[k]] > cell.z[Bezier::corners[last]]) last = k;
  }
  const double nearest = cell.z[Bezier::corners[first]], farthest = cell.z[Bezier::corners[last]];
  if (farthest < near_) return false;
  const Parameter at(D::corners[first][0], D::corners[first][1]);
  if (nearest < near_) {
    Parameter before = at, after(D::corners[last][0], D::corners[last][1]);
    for (int i = 0; i < std::numeric_limits<double>::digits; ++i) {
      const Parameter middle = 0.5 * (before + after);
      std::array<double, 4> z;  // value, du, dv
      NetEvaluation<Bezier>{middle}(cell.z).store(z.data());
      (z[0] < near_ ? before : after) = middle;
    }
    accept({after, near_}, origin, scale);
    return true;
  }
  accept({at, nearest}, origin, scale);

  double rise_u = 0, fall_u = 0, rise_v = 0, fall_v = 0, rise_w = 0, fall_w = 0;
  const auto add = [](double step, double& rise, double& fall) {
    rise = std::max(rise, step);
    fall = std::max(fall, -step);
  };
  for (std::size_t k = 0; k < Bezier::u_pairs.size(); ++k) {
    const auto [from_u, to_u] = Bezier::u_pairs[k];
    const auto [from_v, to_v] = Bezier::v_pairs[k];
    add(cell.z[to_u] - cell.z[from_u], rise_u, fall_u);
    add(cell.z[to_v] - cell.z[from_v], rise_v, fall_v);
    if constexpr (D::corner_count == 3) add(cell.z[to_v] - cell.z[to_u], rise_w, fall_w);
  }
  const double none = error_ / 32;
  return std::min(rise_u, fall_u) <= none && std::min(rise_v, fall_v) <= none && std::min(rise_w, fall_w) <= none;
}

/// On a cell where g = flattening * f has |identity - g'| <= q < 1, the map T(x) = x - g(x) brings every x nearer to a
/// zero x* of the cell: |T(x) - x*| <= q |x - x*| and |x - x*| <= |g(x)| / (1 - q). Hence a T(x) farther than
/// q |g(x)| / (1 - q) from the cell proves that there is no zero. Newton steps only choose the x to ask at. A point
/// within the error of the ray is a zero of g moved by no more than s = |flattening| error, row by row, so that
/// |T(x) - x*| <= (q |g(x)| + s) / (1 - q).
template <class Bezier>
SHAOLIN_FLATTEN auto NewtonFinish<Bezier>::newton(const Net& cell, const Matrix& flattening,
                                                  const Contraction& contraction, Parameter at, PatchHit& hit)
    -> Verdict {
  const double q = contraction.share, slack = contraction.norm(moved(flattening));
  constexpr int most_steps = 12;
  double least = error_;  // of those on the ray how far x and y are off
  bool is_found = false;
  for (int i = 0; i < most_steps; ++i) {
    ++counters_.newton_steps;
    const NetEvaluation<Bezier> evaluation(at);
    std::array<double, 4> at_x, at_y;  // value, du, dv
    evaluation(cell.x).store(at_x.data());
    evaluation(cell.y).store(at_y.data());
    const Eigen::Vector2d f(at_x[0], at_y[0]);
    const double off = f.cwiseAbs().maxCoeff();
    const bool on_ray = off <= error_;
    if (is_found && !(off <= 0.5 * least)) break;
    if (!on_ray) {
      const Eigen::Vector2d g = flattening * f;
      const Parameter image = at - g;
      if (!D::contains(image)) {
        const double reach = (q * contraction.norm(g) + slack) / (1 - q) * (1 + 1e-10);
        if (D::is_outside(image, reach * contraction.weights)) return Verdict::none;
      }
    }
    Matrix jacobian;
    jacobian << at_x[1], at_x[2], at_y[1], at_y[2];
    const Eigen::Vector2d step = -(jacobian.inverse() * f);
    // The step from here wins the last digits: it leaves the square of its length, which is below rounding if it is
    // short and stays in the cell. To first order the distance follows it. Of a grazing ray, where points within the
    // error are far from each other, steps go on as long as each halves what is left.
    constexpr double shortest = 1e-8;
    const bool is_last = step.squaredNorm() <= shortest * shortest;
    if (on_ray || (is_last && D::contains(at + step))) {
      const Eigen::Vector2d whole = is_last ? step : Eigen::Vector2d::Zero();
      Eigen::Vector2d last = is_last ? Eigen::Vector2d(D::nearest(at + step) - at) : Eigen::Vector2d::Zero();
      // Where u and v run nearly one way, a step cut off at the domain's side may lead away from the ray.
      if (on_ray && !((f + jacobian * last).cwiseAbs().maxCoeff() <= off)) last.setZero();
      std::array<double, 4> at_z;
      evaluation(cell.z).store(at_z.data());
      hit = {at + last, at_z[0] + at_z[1] * last.x() + at_z[2] * last.y(), 0, true,
             zero_radius(flattening * f, flattening * jacobian, whole, contraction, moved(flattening)) +
                 (whole - last).cwiseAbs()};
      if (is_last) return Verdict::found;
      is_found = true;
      least = off;
    }
    const Parameter next = D::nearest(at + step);
    if (next == at || !next.allFinite()) break;
    at = next;
  }
  return is_found ? Verdict::found : Verdict::unknown;
}

/// True if the cell is proven to hold a zero, and the exact map one alone, by the contraction principle at one place:
/// with slope q and error s, as zero_radius() derives them, T of the exact map takes all within r = (|g| + s) / (1 - q)
/// of the place to within q r + |g| + s = r of it. So a ray that needs to know no more needs one value of the map, or
/// none: g at the cell's centre is given. The hit is the place, give or take r; its distance is the centre's.
template <class Bezier>
bool NewtonFinish<Bezier>::holds_zero(const Net& cell, const Matrix& flattening, const Contraction& contraction,
                                      const Eigen::Vector2d& g, PatchHit& hit) const {
  const double s = contraction.norm(moved(flattening));
  const double q = contraction.share + 8 * contraction.weights.sum() * s;
  if (!(q < 1)) return false;
  const auto is_near = [&](const Parameter& at, const Eigen::Vector2d& value) {
    const Parameter radius = (contraction.norm(value) + s) / (1 - q) * (1 + 1e-10) * contraction.weights;
    if (!D::contains(at, radius)) return false;
    hit = {at, dot(cell.z, centre_weights), 0, true, radius};
    return true;
  };
  if (is_near(D::centre(), g)) return true;
  const Parameter next = D::centre() - g;
  if (!D::contains(next)) return false;
  ++counters_.newton_steps;
  const NetEvaluation<Bezier> evaluation(next);
  std::array<double, 4> at_x, at_y;  // value, du, dv
  evaluation(cell.x).store(at_x.data());
  evaluation(cell.y).store(at_y.data());
  return is_near(next, flattening * Eigen::Vector2d(at_x[0], at_y[0]));
}

/// The axis along which alone a cell is to be halved: seen from the ray its points move 16 times as far along it as
/// along the other (along the ray, for a cell that lies on it). -1 if both are to be. Where a ray runs beside the
/// straight lines of a ruled patch at a distance near its error, square cells would be a million.
template <class Bezier>
int NewtonFinish<Bezier>::long_axis(const Net& cell, const Parameter& scale) const {
  const bool on_ray = in_band(Range(cell.x), Range(cell.y));
  const auto longest_step = [&](const auto& pairs) {
    double longest = 0;
    for (const auto& [from, to] : pairs) {
      const double step = on_ray ? std::abs(cell.z[to] - cell.z[from])
                                 : std::max(std::abs(cell.x[to] - cell.x[from]), std::abs(cell.y[to] - cell.y[from]));
      longest = std::max(longest, step);
    }
    return longest;
  };
  constexpr double ratio = 16;
  const double along_u = longest_step(Bezier::u_pairs), along_v = longest_step(Bezier::v_pairs);
  if (along_u > ratio * along_v && scale.x() > smallest) return 0;
  if (along_v > ratio * along_u && scale.y() > smallest) return 1;
  return -1;
}

/// Nearest first, where the ray goes through the parts: by their z alone a ray that runs within the surface would come
/// to the near end last, a step at a time. (Seen nearly edge-on, a cell's slope is no guide: errors of x and y count
/// there as much as z does.)
template <class Bezier>
void NewtonFinish<Bezier>::split(const Net& cell, const Parameter& origin, const Parameter& scale) {
  Eigen::Vector2d ab = slope(cell);
  if (ab.cwiseAbs().sum() > steepest) ab.setZero();
  if constexpr (Bezier::DomainType::corner_count == 4) {
    if (const int axis = long_axis(cell, scale); axis >= 0) {
      const auto halves = cell.template bezier<Bezier>().halves(axis);
      const std::array<Net, 2> children{Net(halves[0]), Net(halves[1])};
      Parameter child_scale = scale;
      child_scale[axis] /= 2;
      const bool upper_first = on_ray(children[1], ab).low < on_ray(children[0], ab).low;
      for (const std::size_t k : {upper_first ? 1U : 0U, upper_first ? 0U : 1U}) {
        Parameter child_origin = origin;
        if (k == 1) child_origin[axis] += child_scale[axis];
        visit(children[k], child_origin, child_scale);
      }
      return;
    }
  }
  const std::array<Bezier, 4> quarters = cell.template bezier<Bezier>().split();
  std::array<Net, 4> children;
  std::array<std::pair<double, int>, 4> order;
  for (std::size_t k = 0; k < 4; ++k) {
    children[k] = Net(quarters[k]);
    order[k] = {on_ray(children[k], ab).low, static_cast<int>(k)};
  }
  std::sort(order.begin(), order.end());
  for (const auto& [distance, k] : order) {
    const Parameter child_origin = origin + scale.cwiseProduct(D::to_parent(k, Parameter::Zero()));
    visit(children[static_cast<std::size_t>(k)], child_origin, scale * D::scale(k));
  }
}

}  // namespace shaolin
