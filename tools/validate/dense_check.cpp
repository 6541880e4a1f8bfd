#include "tools/validate/dense_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace shaolin {

namespace {

using Vec2 = Eigen::Vector2d;

/// The line of a ray, with two unit vectors across it.
struct Line {
  Vec3 origin, direction, across1, across2;
  double squared_length;

  Line(const Vec3& o, const Vec3& d) : origin(o), direction(d), squared_length(d.squaredNorm()) {
    const Vec3 unit = d.normalized();
    Eigen::Index smallest;
    unit.cwiseAbs().minCoeff(&smallest);
    across1 = unit.cross(Vec3::Unit(smallest)).normalized();
    across2 = unit.cross(across1);
  }
  Vec2 project(const Vec3& v) const { return {across1.dot(v), across2.dot(v)}; }
  Vec2 offset(const Vec3& p) const { return project(p - origin); }
  double parameter(const Vec3& p) const { return direction.dot(p - origin) / squared_length; }
};

struct Bounds {
  Vec3 lower = Vec3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;

  void add(const Vec3& p) { lower = lower.cwiseMin(p), upper = upper.cwiseMax(p); }
  void add(const Bounds& box) { lower = lower.cwiseMin(box.lower), upper = upper.cwiseMax(box.upper); }

  /// The part of [tmin, tmax] in which the ray is inside; first > second if there is none.
  std::pair<double, double> overlap(const Line& ray, double tmin, double tmax) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double o = ray.origin[axis], d = ray.direction[axis];
      if (d == 0) {
        if (o < lower[axis] || o > upper[axis]) return {1, 0};
        continue;
      }
      double near = (lower[axis] - o) / d, far = (upper[axis] - o) / d;
      if (near > far) std::swap(near, far);
      tmin = std::max(tmin, near), tmax = std::min(tmax, far);
    }
    return {tmin, tmax};
  }
};

/// The barycentric coordinates of the triangle's point that is closest to 0, in the plane.
std::array<double, 3> closest_to_origin(const std::array<Vec2, 3>& p) {
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  std::array<double, 3> w{cross(p[1], p[2]) / area, cross(p[2], p[0]) / area, cross(p[0], p[1]) / area};
  if (area != 0 && w[0] >= 0 && w[1] >= 0 && w[2] >= 0) return w;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec2 edge = p[j] - p[i];
    const double length = edge.squaredNorm();
    const double s = length > 0 ? std::clamp(-p[i].dot(edge) / length, 0.0, 1.0) : 0;
    const double distance = (p[i] + s * edge).squaredNorm();
    if (distance >= best) continue;
    best = distance;
    w = {0, 0, 0};
    w[i] = 1 - s, w[j] = s;
  }
  return w;
}

}  // namespace

class DenseCheck::Implementation {
 public:
  Implementation(const Oracle& oracle, int level);
  std::optional<OracleHit> closest(const Line& ray, double tmin, double tmax) const;

 private:
  /// Half a cell of a piece's grid: corners (i, j), (i + 2, j), (i, j + 2); an upper one is the same turned around
  /// (i + 2, j + 2). The grid's points between the corners tell how far the surface bulges.
  struct Triangle {
    int piece;
    short i, j;
    bool upper;
    double bulge;
  };
  struct Piece {
    int face, sub;
  };
  struct Node {
    Bounds box;
    int first, count;  // count 0: an inner node with children first and first + 1
  };
  using Grid = std::array<std::array<int, 2>, 3>;

  static Grid grid_corners(const Triangle& triangle);
  const Vec3& point(int piece, int i, int j) const {
    return points_[(static_cast<std::size_t>(piece) * (steps_ + 1) + i) * (steps_ + 1) + j];
  }
  void add_piece(int face, int sub);
  void add_triangle(Triangle triangle);
  Bounds box_of(const Triangle& triangle) const;
  void build(std::size_t node, int first, int end);
  void look(const Line& ray, const Triangle& triangle, double tmin, std::optional<OracleHit>& best, double& tmax) const;
  std::optional<OracleHit> polish(const Line& ray, SurfaceParameter at) const;
  SurfaceParameter inside(SurfaceParameter at) const;

  const Oracle& oracle_;
  int steps_;
  std::vector<Piece> pieces_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

DenseCheck::Implementation::Implementation(const Oracle& oracle, int level) : oracle_(oracle), steps_(1 << level) {
  for (int face = 0; face < oracle.face_count(); ++face) {
    for (int sub = 0; oracle.has_limit(face) && sub < oracle.sub_count(face); ++sub) add_piece(face, sub);
  }
  nodes_.push_back({});
  build(0, 0, static_cast<int>(triangles_.size()));
}

void DenseCheck::Implementation::add_piece(int face, int sub) {
  const int piece = static_cast<int>(pieces_.size());
  pieces_.push_back({face, sub});
  const auto in_domain = [&](int i, int j) { return !oracle_.triangular() || i + j <= steps_; };
  for (int i = 0; i <= steps_; ++i) {
    for (int j = 0; j <= steps_; ++j) {
      const SurfaceParameter at{face, sub, static_cast<double>(i) / steps_, static_cast<double>(j) / steps_};
      points_.push_back(in_domain(i, j) ? oracle_.evaluate(at)->position : Vec3::Zero());
    }
  }
  for (short i = 0; i < steps_; i += 2) {
    for (short j = 0; j < steps_; j += 2) {
      if (in_domain(i + 2, j)) add_triangle({piece, i, j, false, 0});
      if (in_domain(i + 2, j + 2)) add_triangle({piece, i, j, true, 0});
    }
  }
}

DenseCheck::Implementation::Grid DenseCheck::Implementation::grid_corners(const Triangle& t) {
  if (t.upper) return {{{t.i + 2, t.j + 2}, {t.i, t.j + 2}, {t.i + 2, t.j}}};
  return {{{t.i, t.j}, {t.i + 2, t.j}, {t.i, t.j + 2}}};
}

/// A quadratic surface is at most 4/3 times farther from the plane inside than in the worst edge's middle; doubled.
void DenseCheck::Implementation::add_triangle(Triangle triangle) {
  const Grid grid = grid_corners(triangle);
  for (std::size_t e = 0; e < 3; ++e) {
    const auto [i0, j0] = grid[e];
    const auto [i1, j1] = grid[(e + 1) % 3];
    const Vec3 chord = (point(triangle.piece, i0, j0) + point(triangle.piece, i1, j1)) / 2;
    const Vec3& middle = point(triangle.piece, (i0 + i1) / 2, (j0 + j1) / 2);
    triangle.bulge = std::max(triangle.bulge, 8.0 / 3 * (middle - chord).norm());
  }
  triangle.bulge += 1e-9 * oracle_.diagonal();
  triangles_.push_back(triangle);
}

Bounds DenseCheck::Implementation::box_of(const Triangle& triangle) const {
  Bounds box;
  for (const auto& [i, j] : grid_corners(triangle)) box.add(point(triangle.piece, i, j));
  box.lower.array() -= triangle.bulge;
  box.upper.array() += triangle.bulge;
  return box;
}

void DenseCheck::Implementation::build(std::size_t node, int first, int end) {
  Bounds box, middles;
  for (int t = first; t < end; ++t) {
    const Bounds one = box_of(triangles_[t]);
    box.add(one);
    middles.add(Vec3((one.lower + one.upper) / 2));
  }
  nodes_[node] = {box, first, end - first};
  if (end - first <= 4) return;
  Eigen::Index axis;
  (middles.upper - middles.lower).maxCoeff(&axis);
  const int half = first + (end - first) / 2;
  const auto middle = [&](const Triangle& t) {
    double sum = 0;
    for (const auto& [i, j] : grid_corners(t)) sum += point(t.piece, i, j)[axis];
    return sum;
  };
  std::nth_element(triangles_.begin() + first, triangles_.begin() + half, triangles_.begin() + end,
                   [&](const Triangle& a, const Triangle& b) { return middle(a) < middle(b); });
  const int children = static_cast<int>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = children, nodes_[node].count = 0;
  build(static_cast<std::size_t>(children), first, half);
  build(static_cast<std::size_t>(children) + 1, half, end);
}

SurfaceParameter DenseCheck::Implementation::inside(SurfaceParameter at) const {
  if (oracle_.triangular() && at.u + at.v > 1) {
    const double excess = (at.u + at.v - 1) / 2;
    at.u -= excess, at.v -= excess;
  }
  at.u = std::clamp(at.u, 0.0, 1.0);
  at.v = std::clamp(at.v, 0.0, oracle_.triangular() ? 1 - at.u : 1.0);
  return at;
}

/// Newton's iteration for the two distances across the ray, halving steps that do not improve. An irregular corner has
/// no derivatives: from there it restarts a little inside.
std::optional<OracleHit> DenseCheck::Implementation::polish(const Line& ray, SurfaceParameter at) const {
  const auto distance_at = [&](const SurfaceParameter& p) { return ray.offset(oracle_.evaluate(p)->position).norm(); };
  double distance = distance_at(at);
  for (int iteration = 0; iteration < 50 && distance > 0; ++iteration) {
    SurfaceParameter from = at;
    if (!oracle_.evaluate(from)->derivatives) {
      const double third = 1.0 / 3, away = 1e-6;
      from.u += away * (third - from.u), from.v += away * (third - from.v);
    }
    const std::optional<LimitSample> sample = oracle_.evaluate(from);
    if (!sample->derivatives) break;
    Eigen::Matrix2d jacobian;
    jacobian << ray.project(sample->derivatives->du), ray.project(sample->derivatives->dv);
    const Vec2 step = jacobian.colPivHouseholderQr().solve(ray.offset(sample->position));
    if (!step.allFinite()) break;
    bool better = false;
    for (double length = 1; length > 1e-3 && !better; length /= 2) {
      const SurfaceParameter to = inside({at.face, at.sub, from.u - length * step.x(), from.v - length * step.y()});
      const double there = distance_at(to);
      if (!(there < distance)) continue;
      better = true;
      at = to, distance = there;
    }
    if (!better) break;
  }
  if (!(distance <= 1e-11 * oracle_.diagonal())) return std::nullopt;
  const std::optional<LimitSample> sample = oracle_.evaluate(at);
  return OracleHit{ray.parameter(sample->position), at, *sample};
}

/// Starts from the triangle's point that is closest to the line; where the triangle stands edge-on, two roots may lie
/// in one cell: then from its corners also.
void DenseCheck::Implementation::look(const Line& ray, const Triangle& triangle, double tmin,
                                      std::optional<OracleHit>& best, double& tmax) const {
  const Grid grid = grid_corners(triangle);
  std::array<Vec3, 3> corners;
  std::array<Vec2, 3> flat;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = point(triangle.piece, grid[k][0], grid[k][1]);
    flat[k] = ray.offset(corners[k]);
  }
  const auto w = closest_to_origin(flat);
  if ((w[0] * flat[0] + w[1] * flat[1] + w[2] * flat[2]).norm() > triangle.bulge) return;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const bool edge_on = std::abs(normal.dot(ray.direction)) < 0.3 * normal.norm() * std::sqrt(ray.squared_length);
  const auto start_at = [&](const std::array<double, 3>& weights) {
    SurfaceParameter at{pieces_[triangle.piece].face, pieces_[triangle.piece].sub, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
      at.u += weights[k] * grid[k][0] / steps_, at.v += weights[k] * grid[k][1] / steps_;
    const auto hit = polish(ray, inside(at));
    if (!hit || hit->t < tmin || hit->t > tmax) return;
    best = hit, tmax = hit->t;
  };
  start_at(w);
  for (std::size_t k = 0; edge_on && k < 3; ++k) {
    std::array<double, 3> corner{0.1, 0.1, 0.1};
    corner[k] = 0.8;
    start_at(corner);
  }
}

std::optional<OracleHit> DenseCheck::Implementation::closest(const Line& ray, double tmin, double tmax) const {
  std::optional<OracleHit> best;
  const auto entry = [&](int node) { return nodes_[node].box.overlap(ray, tmin, tmax); };
  std::vector<std::pair<double, int>> stack;
  const auto push = [&](int node) {
    if (const auto [near, far] = entry(node); near <= far) stack.emplace_back(near, node);
  };
  push(0);
  while (!stack.empty()) {
    const auto [near, index] = stack.back();
    stack.pop_back();
    if (near > tmax) continue;
    const Node& node = nodes_[index];
    for (int t = node.first; t < node.first + node.count; ++t) look(ray, triangles_[t], tmin, best, tmax);
    if (node.count > 0 || triangles_.empty()) continue;
    push(node.first);
    push(node.first + 1);
    const std::size_t n = stack.size();  // the nearer child goes on top
    if (n >= 2 && stack[n - 1].first > stack[n - 2].first && stack[n - 2].second == node.first) {
      std::swap(stack[n - 1], stack[n - 2]);
    }
  }
  return best;
}

DenseCheck::DenseCheck(const Oracle& oracle, int level) {
  if (level < 1 || level > 10) throw std::out_of_range("DenseCheck expects a level from 1 to 10");
  implementation_ = std::make_unique<Implementation>(oracle, level);
}
DenseCheck::~DenseCheck() = default;
DenseCheck::DenseCheck(DenseCheck&&) noexcept = default;

std::optional<OracleHit> DenseCheck::closest(const Vec3& origin, const Vec3& direction, double tmin,
                                             double tmax) const {
  return implementation_->closest(Line(origin, direction), tmin, tmax);
}

bool is_transversal(const OracleHit& hit, const Vec3& direction) {
  return std::abs(hit.sample.normal.dot(direction)) > 1e-4 * direction.norm();
}

}  // namespace shaolin
