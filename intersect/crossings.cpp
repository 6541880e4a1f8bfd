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
#include "corner_disk.h"

namespace shaolin {

namespace {

/// Where nothing is known of the curvature: rays that pass an outline at a distance within rounding, some 160 u of a
/// length L, see the surface at angles up to sqrt(2 * 160 u L / R) for a radius of curvature R: 2e-7 for R = L, and
/// this for R = L / 25. Where nothing is proven of a contact, smaller ones have no sign.
constexpr double grazing = 1e-6;

/// How a ray goes on at a contact: to one side of the surface, until it comes out again.
struct Way {
  int side;       ///< the sign of n.d
  double depth;   ///< in errors of the contact
  double length;  ///< along the ray

  /// Below this depth the two ends of a way may not be told apart: one may be found and proven and the other not, or
  /// both be one contact.
  static constexpr double least_depth = 16;
  bool is_deep() const { return depth > least_depth; }
};

/// At a cosine c and a normal curvature k along the ray it goes in by c^2 / (2 k) before it comes out again, 2 c / k
/// farther on; or, on a flat face of extent s, by c s at most.
Way way_by_curvature(const Contact& contact, const Derivatives& d, double cosine, const Vec3& direction) {
  const int side = cosine > 0 ? 1 : cosine < 0 ? -1 : 0;
  const double c = std::abs(cosine);
  const Vec3& normal = contact.hit.sample.normal;
  Eigen::Matrix2d metric;
  metric << d.du.dot(d.du), d.du.dot(d.dv), d.du.dot(d.dv), d.dv.dot(d.dv);
  const Eigen::Vector2d along = metric.inverse() * Eigen::Vector2d(d.du.dot(direction), d.dv.dot(direction));
  const double curvature =
      std::abs(normal.dot(d.duu) * along.x() * along.x() + 2 * normal.dot(d.duv) * along.x() * along.y() +
               normal.dot(d.dvv) * along.y() * along.y());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(curvature)) return {side, contact.is_proven || c > grazing ? infinity : 0, 0};
  const double extent = d.du.norm() + d.dv.norm();
  const double depth = std::min(curvature > 0 ? c * c / (2 * curvature) : infinity, c * extent);
  return {side, depth / contact.error, curvature > 0 ? 2 * c / curvature : infinity};
}

Way way_of(const Contact& contact, const Vec3& direction) {
  const double cosine = contact.hit.sample.normal.dot(direction);
  const auto& derivatives = contact.hit.sample.derivatives;
  // (At a corner, patches may be all of one curvature and size, or of any.)
  if (derivatives && !is_at_corner(contact.hit.at)) return way_by_curvature(contact, *derivatives, cosine, direction);
  const bool counts = contact.is_proven || std::abs(cosine) > grazing;
  return {cosine > 0 ? 1 : cosine < 0 ? -1 : 0, counts ? std::numeric_limits<double>::infinity() : 0, 0};
}

bool share_vertex(const ControlMesh& mesh, int a, int b) {
  if (a == b) return true;
  const std::span<const int> of_a = mesh.face(a), of_b = mesh.face(b);
  return std::find_first_of(of_a.begin(), of_a.end(), of_b.begin(), of_b.end()) != of_a.end();
}

/// The side that a ray goes to at a contact, 0 if that is hidden by rounding.
struct Side {
  int sign;
  bool is_open;  ///< 0, though the ray is not along the surface
};

/// Of contacts in ascending order of distance; `group` tells which are one place. Where the way is not deep, the other
/// end of it decides: if that is a place of its own, both count and cancel, otherwise the ray touches. (Depth alone
/// would not do: it is the same at both ends up to terms of third order only.)
std::vector<Side> sides_of(std::span<const Contact> contacts, std::span<const std::size_t> group,
                           const ControlMesh& mesh, const Vec3& direction) {
  std::vector<Way> ways;
  for (const Contact& contact : contacts) ways.push_back(way_of(contact, direction));
  // What terms of third order may make of lengths and depths; how many contacts are asked to either side (of a curve of
  // contact there are any number).
  constexpr double longer = 4, deeper = 16;
  constexpr std::size_t most = 16;
  const auto are_ends = [&](std::size_t i, std::size_t j) {
    return ways[j].side == -ways[i].side && group[j] != group[i] && ways[j].depth <= deeper * Way::least_depth &&
           std::abs(contacts[j].distance - contacts[i].distance) <= longer * ways[i].length &&
           share_vertex(mesh, contacts[i].hit.at.face, contacts[j].hit.at.face);
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    bool counts = ways[i].is_deep();
    if (!counts && ways[i].depth > 0)
      for (std::size_t j = i - std::min(i, most); !counts && j < std::min(ways.size(), i + most); ++j)
        counts = are_ends(i, j);
    sides.push_back({counts ? ways[i].side : 0, !counts && ways[i].side != 0});
  }
  return sides;
}

/// Contacts that are one crossing, in the order of (face, sub), and the sides that the ray goes to at them.
class Place {
 public:
  Place(std::span<const Contact> contacts, std::span<const Side> sides) : contacts_(contacts) {
    const auto face_of = [](const Contact& contact) { return std::tie(contact.hit.at.face, contact.hit.at.sub); };
    for (std::size_t i = 0; i < contacts.size();) {
      int least = 1, most = -1;
      const std::size_t first = i;
      for (; i < contacts.size() && face_of(contacts[i]) == face_of(contacts[first]); ++i) {
        least = std::min(least, sides[i].sign);
        most = std::max(most, sides[i].sign);
        is_open_ |= sides[i].is_open;
      }
      faces_.emplace_back(contacts[first].hit.at, std::clamp(least + most, -1, 1));
      is_mixed_ |= least < 0 && most > 0;
    }
  }

  /// The nearest contact, or the least uncertain of those that may be the same point; of several the nearest.
  const Contact& surest() const {
    const auto is_nearer = [](const Contact& a, const Contact& b) { return a.distance < b.distance; };
    const Contact* best = &*std::min_element(contacts_.begin(), contacts_.end(), is_nearer);
    const double end = best->distance + best->uncertainty;
    const auto rank = [](const Contact& c) { return std::tie(c.uncertainty, c.distance, c.hit.at.face, c.hit.at.sub); };
    if (best->is_coarse) return *best;
    for (const Contact& contact : contacts_)
      if (contact.distance - contact.uncertainty <= end && rank(contact) < rank(*best)) best = &contact;
    return *best;
  }

  /// The closest hit where the contacts may be.
  std::optional<Hit> closest(const ClosestBetween& closest_between) const {
    double begin = std::numeric_limits<double>::infinity(), end = -begin;
    for (const Contact& contact : contacts_) {
      begin = std::min(begin, contact.distance - contact.uncertainty);
      end = std::max(end, contact.distance + contact.uncertainty);
    }
    return closest_between(begin, end);
  }

  /// All contacts have one sign.
  bool is_clear() const { return !is_mixed_ && has(1) + has(0) + has(-1) == 1; }

  /// No contact has a sign, one for rounding alone.
  bool is_open() const { return is_open_ && !has(1) && !has(-1); }
  /// Which of the faces around a vertex report it is a matter of rounding, and they need not agree.
  bool is_at_vertex() const { return is_at_corner(surest().hit.at); }

  /// How often the faces turn around the ray, by the share that each takes.
  int turns(const LimitSurface& surface, const Vec3& direction) const {
    if (!is_mixed_ && !(has(1) && has(-1))) return has(1) - has(-1);
    // (At the tip of a spike a face has both, and another is met at its corner alone.)
    double sum = 0;
    for (const auto& [at, sign] : faces_)
      sum += sign * (is_at_corner(at) ? corner_angle(at, surface, direction) : std::numbers::pi);
    return static_cast<int>(std::round(sum / (2 * std::numbers::pi)));
  }

  /// A disk that holds all contacts; of an open place, or one at a vertex, of all faces around the vertex that is
  /// nearest to the first.
  std::optional<CornerDisk> disk(const LimitSurface& surface) const {
    std::vector<SurfaceParameter> all;
    for (const Contact& contact : contacts_) all.push_back(contact.hit.at);
    if (is_open() || is_at_vertex()) {
      const std::vector<SurfaceParameter> around =
          surface.places_of(nearest_corner(all.front(), surface.triangular())).all;
      all.insert(all.end(), around.begin(), around.end());
      std::sort(all.begin(), all.end(), [](const SurfaceParameter& x, const SurfaceParameter& y) {
        return std::tie(x.face, x.sub, x.u, x.v) < std::tie(y.face, y.sub, y.u, y.v);
      });
    }
    return CornerDisk::around(all, surface.triangular());
  }
  /// By how much coordinates across the ray may be off.
  double error() const {
    double largest = 0;
    for (const Contact& contact : contacts_) largest = std::max(largest, contact.error);
    return largest;
  }

 private:
  bool has(int wanted) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](const auto& face) { return face.second == wanted; });
  }

  std::span<const Contact> contacts_;
  std::vector<std::pair<SurfaceParameter, int>> faces_;  ///< a contact of each face, and the sum of signs, in [-1, 1]
  bool is_mixed_ = false;                                ///< some face has both
  bool is_open_ = false;
};

/// How often a disk around the place is crossed in all, less what other places in it say; empty where that is unknown.
std::optional<int> turns_within_disk(const Place& place, std::span<const Place> places, const LimitSurface& surface,
                                     const Vec3& direction) {
  // Errors: of the contact on the ray two, of a point of the rim one, and the rim's steps are chords.
  constexpr double clearance = 16;
  std::optional<CornerDisk> disk = place.disk(surface);
  if (!disk) return {};
  std::optional<int> turns =
      disk->grow_and_wind(surface, place.surest().hit.sample.position, direction, clearance * place.error());
  // Where it is large, against rounding so is what a surface bends in it, and a place whose faces agree knows better.
  constexpr double largest_for_clear = 0x1p-12;
  if (place.is_clear() && !place.is_open() && disk->radius() > largest_for_clear) return {};
  for (const Place& other : places) {
    if (!turns || &other == &place || !disk->contains(other.surest().hit.at)) continue;
    if (!other.is_clear()) return {};
    *turns -= other.turns(surface, direction);
  }
  return turns;
}

/// At one of the ray's places.
Sense sense_of(const Place& place, std::span<const Place> places, const LimitSurface& surface, const Vec3& direction) {
  // Of a ray that runs along the surface there are any number of places, and open ones say nothing.
  constexpr std::size_t most_places = 64;
  std::optional<int> turns;
  if (!place.is_clear() || ((place.is_open() || place.is_at_vertex()) && places.size() <= most_places))
    turns = turns_within_disk(place, places, surface, direction);
  if (!turns) turns = place.turns(surface, direction);
  return *turns > 0 ? Sense::leaves : *turns < 0 ? Sense::enters : Sense::touches;
}

}  // namespace

std::uint64_t count_uncertified(const std::vector<Crossing>& crossings) {
  const auto is_uncertified = [](const Crossing& crossing) { return !crossing.hit.certificate.is_certified(); };
  return static_cast<std::uint64_t>(std::count_if(crossings.begin(), crossings.end(), is_uncertified));
}

std::vector<Crossing> crossings(std::vector<Contact> contacts, const LimitSurface& surface, const Vec3& direction,
                                const ClosestBetween& closest) {
  const ControlMesh& mesh = surface.control_mesh();
  const auto rank = [](const Contact& c) { return std::tie(c.distance, c.hit.at.face, c.hit.at.sub); };
  std::sort(contacts.begin(), contacts.end(), [&](const Contact& a, const Contact& b) { return rank(a) < rank(b); });

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

  for (std::size_t i = 0; i < contacts.size(); ++i) group[i] = first_of(i);
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto in_group = [&](std::size_t i) {
    return std::tuple(group[i], contacts[i].hit.at.face, contacts[i].hit.at.sub, i);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return in_group(a) < in_group(b); });
  const std::vector<Side> sides = sides_of(contacts, group, mesh, direction);
  std::vector<Contact> ordered;
  std::vector<Side> ordered_sides;
  for (const std::size_t i : order) {
    ordered.push_back(contacts[i]);
    ordered_sides.push_back(sides[i]);
  }
  std::vector<Place> places;
  for (std::size_t i = 0; i < order.size();) {
    const std::size_t begin = i;
    while (i < order.size() && group[order[i]] == group[order[begin]]) ++i;
    places.emplace_back(std::span<const Contact>(ordered).subspan(begin, i - begin),
                        std::span<const Side>(ordered_sides).subspan(begin, i - begin));
  }

  std::vector<Crossing> result;
  for (const Place& place : places) {
    const Contact& surest = place.surest();
    if (const std::optional<Hit> hit = surest.is_coarse ? place.closest(closest) : surest.hit)
      result.push_back({*hit, sense_of(place, places, surface, direction)});
  }
  // What stood in for a coarse contact may be farther than the next one.
  std::stable_sort(result.begin(), result.end(),
                   [](const Crossing& a, const Crossing& b) { return a.hit.t < b.hit.t; });
  return result;
}

}  // namespace shaolin
