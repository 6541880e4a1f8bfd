#include "tools/validate/exact_hits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "schemes/domain.h"

namespace shaolin {
namespace {

double to_double(const Quad& value) { return static_cast<double>(value); }

struct ExactCrossing {
  QuadVec3 position;
  Quad du, dv;  ///< from the hit's parameters to the crossing's
};

/// Half the distance of the parameters that derivatives are taken from: their error is its square. Exact in doubles as
/// differences, and of the next Newton step it is seen as the product with a step of roundings.
constexpr double half_step = 0x1p-26;

/// The nearest parameter that has `half_step` to all sides in the domain.
Parameter with_room(Parameter at, bool triangular) {
  at = at.cwiseMax(half_step).cwiseMin(1 - half_step);
  if (triangular)
    if (const double over = at.sum() + 2 * half_step - 1; over > 0) at = (at.array() - over).max(half_step).matrix();
  return at;
}

/// One Newton step from the hit's parameters.
ExactCrossing crossing(const QuadOracle& oracle, const Ray& ray, const SurfaceParameter& at, const QuadVec3& on_surface,
                       bool triangular) {
  const Parameter middle = with_room({at.u, at.v}, triangular);
  const auto difference = [&](const Parameter& step) -> QuadVec3 {
    const Parameter a = middle - step, b = middle + step;
    const QuadVec3 rise =
        oracle.position({at.face, at.sub, b.x(), b.y()}) - oracle.position({at.face, at.sub, a.x(), a.y()});
    return rise / Quad((b - a).sum());
  };
  Eigen::Matrix<Quad, 3, 3> system;
  system.col(0) = difference({half_step, 0});
  system.col(1) = difference({0, half_step});
  system.col(2) = -ray.direction.cast<Quad>();
  const QuadVec3 origin = ray.origin.cast<Quad>();
  const QuadVec3 step = system.inverse() * (origin - on_surface);
  return {QuadVec3(origin + step[2] * ray.direction.cast<Quad>()), step[0], step[1]};
}

/// The corners of the control face's side that a parameter is beyond, if it is.
std::vector<std::pair<int, int>> sides_beyond(const ControlMesh& mesh, const SurfaceParameter& at, const Quad& u,
                                              const Quad& v, bool triangular) {
  const auto face = mesh.face(at.face);
  const auto n = face.size();
  const auto side = [&](std::size_t i) { return std::pair(face[i % n], face[(i + 1) % n]); };
  const bool is_sub = n != (triangular ? 3U : 4U);
  const auto corner = is_sub ? static_cast<std::size_t>(at.sub) : 0;
  std::vector<std::pair<int, int>> sides;
  if (v < 0) sides.push_back(side(corner));
  if (u < 0) sides.push_back(side(corner + n - 1));
  if (is_sub) return sides;  // its other sides are within the face
  if (triangular) {
    if (u + v > 1) sides.push_back(side(1));
  } else {
    if (u > 1) sides.push_back(side(1));
    if (v > 1) sides.push_back(side(2));
  }
  return sides;
}

/// Two faces, and no sharpness.
bool is_smooth(const ControlMesh& mesh, const std::pair<int, int>& side) {
  const auto is_side = [&](int a, int b) { return std::minmax(a, b) == std::minmax(side.first, side.second); };
  int faces = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    for (std::size_t i = 0; i < corners.size(); ++i) faces += is_side(corners[i], corners[(i + 1) % corners.size()]);
  }
  return faces == 2 && std::none_of(mesh.sharp_edges.begin(), mesh.sharp_edges.end(), [&](const SharpEdge& edge) {
           return edge.sharpness > 0 && is_side(edge.a, edge.b);
         });
}

class HitCheck {
 public:
  HitCheck(const ControlMesh& mesh, const QuadOracle& oracle) : mesh_(mesh), oracle_(oracle) {}

  void hit(const Ray& ray, const Hit& hit) {
    const QuadVec3 on_surface = oracle_.position(hit.at);
    ++figures.hits;
    if (hit.certificate.is_certified())
      certified(ray, hit, on_surface);
    else
      converged(ray, hit, on_surface);
  }

  ExactHitFigures figures;

 private:
  void certified(const Ray& ray, const Hit& hit, const QuadVec3& on_surface);
  void converged(const Ray& ray, const Hit& hit, const QuadVec3& on_surface);
  void disagree(const char* what, const Ray& ray, const Hit& hit, double error, double allowed) {
    figures.disagreements.push_back({what, hit.at, ray, "t " + exact(hit.t) + " at " + exact(hit.at), error, allowed});
  }

  const ControlMesh& mesh_;
  const QuadOracle& oracle_;
};

void HitCheck::certified(const Ray& ray, const Hit& hit, const QuadVec3& on_surface) {
  ++figures.certified;
  const bool triangular = oracle_.triangular();
  const ExactCrossing found = crossing(oracle_, ray, hit.at, on_surface, triangular);
  const double error = to_double((hit.sample.position.cast<Quad>() - found.position).norm());
  // A longer step is none to a zero of the same cell, and would not be Newton's last.
  constexpr double longest = 0x1p-20;
  if (!(abs(found.du) < longest && abs(found.dv) < longest))
    return disagree("certified hit without a crossing", ray, hit, to_double(abs(found.du) + abs(found.dv)), longest);
  const double size = std::max(hit.sample.position.cwiseAbs().maxCoeff(), ray.origin.cwiseAbs().maxCoeff());
  figures.worst_position = std::max(figures.worst_position, error / oracle_.diagonal());
  figures.worst_ulps = std::max(figures.worst_ulps, std::ldexp(error, 52 - std::ilogb(size)));
  figures.worst_bound_share = std::max(figures.worst_bound_share, error / hit.certificate.error);
  if (!(error <= hit.certificate.error))
    disagree("certified hit farther from the crossing than its error", ray, hit, error, hit.certificate.error);
  for (const auto& side : sides_beyond(mesh_, hit.at, Quad(hit.at.u) + found.du, Quad(hit.at.v) + found.dv, triangular))
    if (!is_smooth(mesh_, side)) disagree("certified hit beyond the surface's side", ray, hit, error, 0);
}

void HitCheck::converged(const Ray& ray, const Hit& hit, const QuadVec3& on_surface) {
  const double off_surface = to_double((hit.sample.position.cast<Quad>() - on_surface).norm()) / oracle_.diagonal();
  const QuadVec3 origin = ray.origin.cast<Quad>(), direction = ray.direction.cast<Quad>();
  const Quad t = (on_surface - origin).dot(direction) / direction.squaredNorm();
  const double residual = to_double((origin + t * direction - on_surface).norm());
  const double reach = std::abs(hit.t) * ray.direction.norm() + oracle_.diagonal();
  figures.worst_residual = std::max(figures.worst_residual, residual / oracle_.diagonal());
  if (!(off_surface <= bar::on_surface)) disagree("hit off the surface", ray, hit, off_surface, bar::on_surface);
  if (!(residual / reach <= bar::on_ray)) disagree("hit off the ray", ray, hit, residual / reach, bar::on_ray);
}

}  // namespace

ExactHitFigures check_exact_hits(const Intersector& ours, const ControlMesh& mesh, const QuadOracle& oracle,
                                 std::span<const ProbeRay> rays) {
  HitCheck check(mesh, oracle);
  for (const ProbeRay& probe : rays) {
    ++check.figures.rays;
    if (const std::optional<Hit> hit = ours.intersect(probe.ray)) check.hit(probe.ray, *hit);
  }
  return check.figures;
}

}  // namespace shaolin
