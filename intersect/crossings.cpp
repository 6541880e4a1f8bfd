#include "crossings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "../schemes/limit_surface.h"

namespace shaolin {

namespace {

/// Where nothing is known of the curvature: rays that pass an outline at a distance within rounding, some 160 u of a
/// length L, see the surface at angles up to sqrt(2 * 160 u L / R) for a radius of curvature R: 2e-7 for R = L, and
/// this for R = L / 25. Where nothing is proven of a contact, smaller ones have no sign.
constexpr double grazing = 1e-6;

/// Whether a ray goes on through the surface at a contact, and does not touch it to within rounding. At a cosine c and
/// a normal curvature k along the ray it goes in by c^2 / (2 k) before it comes out again, 2 c / k farther on; or, on a
/// flat face of extent s, by c s at most. Below 16 times the error the two ends of the way may not be told apart: one
/// may be found and proven and the other not, or both be one contact. The rule is the same at both, for c and k are the
/// same at both up to terms of third order; so they cancel, whichever way it decides.
bool goes_through(const Contact& contact, const Derivatives& d, double cosine, const Vec3& direction) {
  constexpr double depth = 16;
  const Vec3& normal = contact.hit.sample.normal;
  Eigen::Matrix2d metric;
  metric << d.du.dot(d.du), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.dot(d.dv);
  const Eigen::Vector2d way = metric.inverse() * Eigen::Vector2d(d.du.dot(direction), d.dv.dot(direction));
  const double curvature = std::abs(normal.dot(d.duu) * way.x() * way.x() + 2 * normal.dot(d.duv) * way.x() * way.y() +
                                    normal.dot(d.dvv) * way.y() * way.y());
  if (!std::isfinite(curvature)) return contact.is_proven || std::abs(cosine) > grazing;
  const double extent = d.du.norm() + d.dv.norm();
  return cosine * cosine > 2 * depth * contact.error * curvature && std::abs(cosine) * extent > depth * contact.error;
}

/// True within 1e-6 of a corner of the face, where patches may be all of one curvature and size, or of any.
bool is_at_corner(const SurfaceParameter& at) {
  const auto is_end = [](double x) { return x < 1e-6 || x > 1 - 1e-6; };
  return is_end(at.u) && is_end(at.v);
}

int sign(const Contact& contact, const Vec3& direction) {
  const double cosine = contact.hit.sample.normal.dot(direction);
  const auto& derivatives = contact.hit.sample.derivatives;
  const bool counts = derivatives && !is_at_corner(contact.hit.at)
                          ? goes_through(contact, *derivatives, cosine, direction)
                          : contact.is_proven || std::abs(cosine) > grazing;
  return !counts ? 0 : cosine > 0 ? 1 : cosine < 0 ? -1 : 0;
}

bool share_vertex(const ControlMesh& mesh, int a, int b) {
  if (a == b) return true;
  const std::span<const int> of_a = mesh.face(a), of_b = mesh.face(b);
  return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

/// The angle that a face takes around the ray at a contact: pi, but at a corner. There it is that between the sides, of
/// which short chords will do, for the angles of all faces together are a multiple of 2 pi. (Tangents may be missing.)
double angle(const SurfaceParameter& at, const LimitSurface& surface, const Vec3& direction) {
  constexpr double chord = 1e-3;
  if (!is_at_corner(at)) return std::numbers::pi;
  const double u = std::round(at.u), v = std::round(at.v);
  SurfaceParameter a{at.face, at.sub, u == 0 ? chord : 1 - chord, v}, b{at.face, at.sub, u, v == 0 ? chord : 1 - chord};
  if (surface.triangular() && u == 1) b.u = 1 - chord;
  if (surface.triangular() && v == 1) a.v = 1 - chord;
  const auto corner = surface.evaluate({at.face, at.sub, u, v}), to_a = surface.evaluate(a), to_b = surface.evaluate(b);
  if (!corner || !to_a || !to_b) return std::numbers::pi;
  const auto seen = [&](const std::optional<LimitSample>& end) -> Vec3 {
    const Vec3 side = end->position - corner->position;
    return side - side.dot(direction) * direction;
  };
  return std::atan2(seen(to_a).cross(seen(to_b)).norm(), seen(to_a).dot(seen(to_b)));
}

/// Of contacts at one place, in the order of (face, sub).
Sense sense_of(std::span<const Contact> contacts, const LimitSurface& surface, const Vec3& direction) {
  std::vector<std::pair<const SurfaceParameter*, int>> faces;  // and the sign of each
  // Some face has both.
  bool is_mixed = false;
  for (std::size_t i = 0; i < contacts.size();) {
    const SurfaceParameter& at = contacts[i].hit.at;
    int least = 1, most = -1;
    for (; i < contacts.size() && contacts[i].hit.at.face == at.face && contacts[i].hit.at.sub == at.sub; ++i) {
      least = std::min(least, sign(contacts[i], direction));
      most = std::max(most, sign(contacts[i], direction));
    }
    faces.emplace_back(&at, std::clamp(least + most, -1, 1));
    is_mixed |= least < 0 && most > 0;
  }
  const auto has_sign = [&](int wanted) {
    return std::any_of(faces.begin(), faces.end(), [&](const auto& face) { return face.second == wanted; });
  };
  double turns = has_sign(1) - has_sign(-1);
  // (At the tip of a spike a face has both, and another is met at its corner alone.)
  if (is_mixed || (has_sign(1) && has_sign(-1))) {
    turns = 0;
    for (const auto& [at, sign] : faces) turns += sign * angle(*at, surface, direction);
    turns = std::round(turns / (2 * std::numbers::pi));
  }
  return turns > 0 ? Sense::leaves : turns < 0 ? Sense::enters : Sense::touches;
}

/// Of contacts at one place: which is least uncertain, the nearest of several.
const Contact& surest_of(std::span<const Contact> contacts) {
  const auto rank = [](const Contact& c) {
    return std::tie(c.uncertainty, c.distance, c.hit.at.face, c.hit.at.sub);
  };
  return *std::min_element(contacts.begin(), contacts.end(),
                           [&](const Contact& a, const Contact& b) { return rank(a) < rank(b); });
}

/// Of contacts at one place.
std::optional<Hit> closest_of(std::span<const Contact> contacts, const ClosestBetween& closest) {
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (const Contact& contact : contacts) {
    begin = std::min(begin, contact.distance - contact.uncertainty);
    end = std::max(end, contact.distance + contact.uncertainty);
  }
  return closest(begin, end);
}

}  // namespace

std::uint64_t count_uncertified(const std::vector<Crossing>& crossings) {
  const auto is_uncertified = [](const Crossing& crossing) { return !crossing.hit.certificate.is_certified(); };
  return static_cast<std::uint64_t>(std::count_if(crossings.begin(), crossings.end(), is_uncertified));
}

std::vector<Crossing> crossings(std::vector<Contact> contacts, const LimitSurface& surface, const Vec3& direction,
                                const ClosestBetween& closest) {
  const ControlMesh& mesh = surface.control_mesh();
  const auto place = [](const Contact& c) { return std::tie(c.distance, c.hit.at.face, c.hit.at.sub); };
  std::sort(contacts.begin(), contacts.end(), [&](const Contact& a, const Contact& b) { return place(a) < place(b); });

  // Which contacts are one: the first of each group stands for it.
  std::vector<std::size_t> group(contacts.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  const auto first_of = [&](std::size_t i) {
    while (group[i] != i) i = group[i] = group[group[i]];
    return i;
  };
  // Of each face, the contact so far that reaches farthest: of a curve of contact there are many, of faces few.
  const auto end = [&](std::size_t i) { return contacts[i].distance + contacts[i].uncertainty; };
  std::vector<std::size_t> farthest;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double begin = contacts[i].distance - contacts[i].uncertainty;
    std::size_t* own = nullptr;
    for (std::size_t& other : farthest) {
      const int face = contacts[other].hit.at.face;
      if (end(other) >= begin && share_vertex(mesh, face, contacts[i].hit.at.face)) {
        const std::size_t a = first_of(other), b = first_of(i);
        group[std::max(a, b)] = std::min(a, b);
      }
      if (face == contacts[i].hit.at.face) own = &other;
    }
    if (!own)
      farthest.push_back(i);
    else if (end(i) > end(*own))
      *own = i;
  }

  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const std::size_t i : order) group[i] = first_of(i);
  const auto in_group = [&](std::size_t i) {
    return std::tuple(group[i], contacts[i].hit.at.face, contacts[i].hit.at.sub, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return in_group(a) < in_group(b); });

  std::vector<Crossing> result;
  std::vector<Contact> together;
  for (std::size_t i = 0; i < order.size();) {
    const std::size_t first = group[order[i]];
    together.clear();
    for (; i < order.size() && group[order[i]] == first; ++i) together.push_back(contacts[order[i]]);
    const Contact& surest = surest_of(together);
    if (const std::optional<Hit> hit = surest.is_coarse ? closest_of(together, closest) : surest.hit)
      result.push_back({*hit, sense_of(together, surface, direction)});
  }
  // What stood in for a coarse contact may be farther than the next one.
  std::stable_sort(result.begin(), result.end(),
                   [](const Crossing& a, const Crossing& b) { return a.hit.t < b.hit.t; });
  return result;
}

}  // namespace shaolin
