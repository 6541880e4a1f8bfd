#include "crossings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>

namespace shaolin {

namespace {

/// Rays that pass an outline at a distance within rounding, some 160 u of a length L, see the surface at angles up to
/// sqrt(2 * 160 u L / R) for a radius of curvature R: 2e-7 for R = L, and this for R = L / 25. Where nothing is proven
/// of a contact, smaller ones have no sign.
constexpr double grazing = 1e-6;

int sign(const Contact& contact, const Vec3& direction) {
  const double cosine = contact.hit.sample.normal.dot(direction);
  if (!contact.is_proven && !(std::abs(cosine) > grazing)) return 0;
  return cosine > 0 ? 1 : cosine < 0 ? -1 : 0;
}

bool share_vertex(const ControlMesh& mesh, int a, int b) {
  if (a == b) return true;
  const std::span<const int> of_a = mesh.face(a), of_b = mesh.face(b);
  return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

/// The angle that a face takes at the contact, seen along the ray.
double angle(const Contact& contact, bool triangles, const Vec3& direction) {
  const SurfaceParameter& at = contact.hit.at;
  const auto is_end = [](double x) { return x == 0 || x == 1; };
  const bool is_corner = is_end(at.u) && is_end(at.v);
  if (!is_corner || !contact.hit.sample.derivatives) return std::numbers::pi;
  const auto seen = [&](const Vec3& v) -> Vec3 { return v - v.dot(direction) * direction; };
  const Derivatives& d = *contact.hit.sample.derivatives;
  Vec3 a = seen(d.du), b = seen(d.dv);
  if (triangles) {  // towards the two other corners
    if (at.u == 1)
      a = -a, b = b + a;
    else if (at.v == 1)
      b = -b, a = a + b;
  } else {
    if (at.u == 1) a = -a;
    if (at.v == 1) b = -b;
  }
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Of contacts at one place, in the order of (face, sub).
Sense sense_of(std::span<const Contact> contacts, bool triangles, const Vec3& direction) {
  int positive = 0, negative = 0;
  double winding = 0;
  for (std::size_t i = 0; i < contacts.size();) {
    const auto same_face = [&](const Contact& other) {
      return other.hit.at.face == contacts[i].hit.at.face && other.hit.at.sub == contacts[i].hit.at.sub;
    };
    int least = 1, most = -1;
    const Contact& first = contacts[i];
    std::size_t end = i;
    for (; end < contacts.size() && same_face(contacts[end]); ++end) {
      least = std::min(least, sign(contacts[end], direction));
      most = std::max(most, sign(contacts[end], direction));
    }
    const int sum = std::clamp(least + most, -1, 1);
    positive += sum > 0;
    negative += sum < 0;
    winding += sum * angle(first, triangles, direction);
    i = end;
  }
  if (negative == 0) return positive == 0 ? Sense::touches : Sense::leaves;
  if (positive == 0) return Sense::enters;
  const double turns = std::round(winding / (2 * std::numbers::pi));
  return turns > 0 ? Sense::leaves : turns < 0 ? Sense::enters : Sense::touches;
}

}  // namespace

std::vector<Crossing> crossings(std::vector<Contact> contacts, const ControlMesh& mesh, const Vec3& direction) {
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
    const bool triangles = mesh.all_triangles();
    result.push_back({contacts[first].hit, sense_of(together, triangles, direction)});
  }
  return result;
}

}  // namespace shaolin
