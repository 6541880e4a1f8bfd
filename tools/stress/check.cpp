#include "tools/stress/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "schemes/errors.h"
#include "tools/validate/agreement.h"

namespace shaolin::stress {

namespace {

/// A hit may be off by so many of Subject::rounding(). The exact finish accepts points within twice its bound across
/// the ray in two coordinates, takes cells for points that reach 16 times as far along it, whose middle may be off by
/// 8, and its own evaluation, ours and the ray's point at t are off by one each: sqrt(4 + 4 + 64) + 3 < 12.
constexpr double sound = 12;

/// Below this cosine (6 degrees) a ray may cross a curved surface twice near one place.
constexpr double steep_enough = 0.1;

double unit_in_last_place(double magnitude) { return std::nextafter(magnitude, infinity) - magnitude; }

double cosine_of(const Ray& ray, const Hit& hit) {
  return std::abs(hit.sample.normal.dot(ray.direction.stableNormalized()));
}

int sense_of(const Crossing& crossing) { return static_cast<int>(crossing.sense); }

}  // namespace

std::string text(const Hit& hit) {
  return "t " + exact(hit.t) + " at " + exact(hit.at) + " position " + exact(hit.sample.position) + " normal " +
         exact(hit.sample.normal);
}

void Check::fail(Fault fault, const Ray& ray, std::string detail) {
  bool& failed = failed_[static_cast<std::size_t>(fault)];
  if (failed) return;
  failed = true;
  tally_.fail({fault, family_, subject_.name(), subject_.variant(), std::move(detail), ray});
}

void Check::fail_at(double cosine, Fault fault, const Ray& ray, std::string detail) {
  if (cosine >= subject_.grazing(ray)) return fail(fault, ray, std::move(detail));
  leave_undecided();
}

void Check::leave_undecided() {
  tally_.undecided += !undecided_;
  undecided_ = true;
}

bool Check::runs_along(const Ray& ray, double from, double to) const {
  constexpr std::array<double, 3> shares{0.25, 0.5, 0.75};
  return std::all_of(shares.begin(), shares.end(), [&](double share) {
    const Vec3 between = ray.origin + (from + share * (to - from)) * ray.direction;
    return subject_.distance(between) <= 2 * subject_.rounding(ray);
  });
}

double Check::slack(const Ray& ray, double cosine) const {
  constexpr double grazing = 1e-6;
  return 4 * subject_.rounding(ray) / std::max(cosine, grazing) / ray.direction.stableNorm();
}

/// How far the surface moves if a parameter moves by a unit of its last place. Next to most corners that is a rounding
/// of coordinates; at a pole, where the surface goes with the 0.64th power of the parameters, it is 1e-11.
double Check::resolution(const SurfaceParameter& at) const {
  const Vec3 here = subject_.evaluate(at).position;
  double largest = 0;
  for (double SurfaceParameter::*const parameter : {&SurfaceParameter::u, &SurfaceParameter::v}) {
    SurfaceParameter beside = at;
    beside.*parameter = std::nextafter(at.*parameter, 0);
    largest = std::max(largest, (subject_.evaluate(beside).position - here).stableNorm());
  }
  return largest;
}

/// What is wrong with a hit, or an empty string; its error is noted.
std::string Check::unsound(const Ray& ray, const Hit& hit) {
  const LimitSurface& surface = subject_.surface();
  const SurfaceParameter& at = hit.at;
  if (!(hit.t >= ray.tmin && hit.t <= ray.tmax)) return "outside of the interval: " + text(hit);
  if (at.face < 0 || at.face >= surface.face_count() || !surface.has_limit(at.face) || at.sub < 0 ||
      at.sub >= surface.sub_count(at.face))
    return "no such face: " + text(hit);
  if (!(at.u >= 0 && at.v >= 0 && at.u <= 1 && at.v <= 1 && (!surface.triangular() || at.u + at.v <= 1)))
    return "no such parameter: " + text(hit);
  const double length = hit.sample.normal.norm();
  if (!(length == 0 || std::abs(length - 1) < 1e-12)) return "its normal is not unit: " + text(hit);
  const Vec3 position = subject_.evaluate(at).position, direction = ray.direction.stableNormalized();
  const Vec3 away = position - ray.origin - hit.t * ray.direction;
  const double along = std::abs(away.dot(direction)), across = (away - away.dot(direction) * direction).stableNorm();
  const double error = std::max(across, (position - hit.sample.position).stableNorm());
  const double most_off = sound * subject_.rounding(ray);
  const double most_along = slack(ray, cosine_of(ray, hit)) * ray.direction.stableNorm();
  const auto is_sound = [&](double room) { return error <= most_off + room && along <= most_along + room; };
  const bool is_resolved = is_sound(0);
  if (!is_resolved && !is_sound(resolution(at)))
    return "off the surface or the ray by " + exact(error) + ", along the ray by " + exact(along) + ": " + text(hit) +
           ", surface there " + exact(position);
  // (Where parameters are too coarse, the position's own.)
  const double counted = is_resolved ? error : (hit.sample.position - ray.origin - hit.t * ray.direction).stableNorm();
  tally_.worst_error = std::max(tally_.worst_error, counted / unit_in_last_place(subject_.magnitude(ray)));
  return {};
}

bool Check::hit(const Ray& ray, const Hit& hit) {
  ++tally_.hits;
  std::string fault = unsound(ray, hit);
  if (!fault.empty()) {
    fail(Fault::ghost, ray, std::move(fault));
  } else if (subject_.queries().certify(ray, hit).is_certified()) {
    ++tally_.certified;
  } else {
    ++tally_.uncertified[static_cast<std::size_t>(reason_of(subject_, ray, hit))];
  }
  return !failed_[static_cast<std::size_t>(Fault::ghost)];
}

int Check::winding(std::span<const Crossing> all) {
  int sum = 0;
  for (const Crossing& crossing : all) sum += sense_of(crossing);
  return sum;
}

int Check::winding(const Ray& ray) {
  const std::vector<Crossing> all = subject_.queries().all_hits(ray);
  for (const Crossing& crossing : all)
    if (std::string fault = unsound(ray, crossing.hit); !fault.empty()) fail(Fault::ghost, ray, std::move(fault));
  return winding(all);
}

void Check::ray(const Probe& probe) {
  failed_ = {};
  undecided_ = false;
  try {
    answers(probe);
  } catch (const InputError& error) {
    fail(Fault::ghost, probe.ray, std::string("no answer: ") + error.what());
  }
}

void Check::answers(const Probe& probe) {
  const Ray& ray = probe.ray;
  const std::optional<Hit> closest = subject_.queries().intersect(ray);
  if (closest) hit(ray, *closest);
  if (subject_.queries().occluded(ray) != closest.has_value())
    fail(Fault::lost, ray, closest ? "occluded() is false, " + text(*closest) : "occluded() is true, there is no hit");
  if (probe.target) {
    const double latest = probe.target->t + slack(ray, probe.target->cosine);
    if (closest && closest->t > latest && runs_along(ray, probe.target->t, closest->t))
      leave_undecided();
    else if (!closest || closest->t > latest)
      fail(Fault::lost, ray,
           (closest ? "a farther one: " + text(*closest) : "no hit") + ", expected t " + exact(probe.target->t));
  }
  if (probe.closest_only) return;
  Ray line = ray;
  line.tmin = -infinity;
  line.tmax = infinity;
  const std::vector<Crossing> found = subject_.queries().all_hits(line);
  all({line, probe.target}, found);
  first(ray, closest, found);
}

void Check::all(const Probe& probe, std::span<const Crossing> all) {
  double flattest = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double cosine = cosine_of(probe.ray, all[i].hit);
    flattest = std::min(flattest, cosine);
    if (std::string fault = unsound(probe.ray, all[i].hit); !fault.empty())
      fail_at(cosine, Fault::ghost, probe.ray, fault);
    if (i > 0 && all[i].hit.t < all[i - 1].hit.t) fail(Fault::ghost, probe.ray, "out of order: " + text(all[i].hit));
  }
  if (probe.target && probe.target->is_exact) target(probe, all);
  if (!subject_.is_closed() || winding(all) == 0) return;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Hit &a = all[i - 1].hit, &b = all[i].hit;
    const double cosine = std::min(cosine_of(probe.ray, a), cosine_of(probe.ray, b));
    if (sense_of(all[i]) * sense_of(all[i - 1]) == 1 && b.t - a.t <= 2 * slack(probe.ray, cosine))
      return fail_at(flattest, Fault::duplicate, probe.ray, "two at one place: " + text(a) + " and " + text(b));
  }
  // Where the ray goes on along the surface it may leave it on either side, anywhere.
  const auto goes_along = [&](const Crossing& c) {
    const double far = 100 * slack(probe.ray, cosine_of(probe.ray, c.hit));
    return runs_along(probe.ray, c.hit.t, c.hit.t + far) || runs_along(probe.ray, c.hit.t, c.hit.t - far);
  };
  if (std::any_of(all.begin(), all.end(), goes_along)) return leave_undecided();
  std::string senses = "entering and leaving do not cancel:";
  for (const Crossing& crossing : all)
    senses += ' ' + std::to_string(sense_of(crossing)) + " at t " + exact(crossing.hit.t) + " cosine " +
              exact(cosine_of(probe.ray, crossing.hit)) + ',';
  fail_at(std::min(flattest, probe.target ? probe.target->cosine : 1), Fault::lost, probe.ray, senses);
}

void Check::target(const Probe& probe, std::span<const Crossing> all) {
  const Probe::Target& target = *probe.target;
  const double near = slack(probe.ray, target.cosine);
  const auto is_within = [&](const Crossing& c, double room) { return std::abs(c.hit.t - target.t) <= room; };
  const auto count = std::count_if(all.begin(), all.end(), [&](const Crossing& c) { return is_within(c, near); });
  // At a corner the face that reports it may be flatter than the one aimed at.
  const bool is_there = std::any_of(all.begin(), all.end(), [&](const Crossing& c) {
    return is_within(c, std::max(near, slack(probe.ray, cosine_of(probe.ray, c.hit))));
  });
  // Of a piece of the surface along the ray one hit stands for all.
  const auto leads_there = [&](const Crossing& c) { return runs_along(probe.ray, c.hit.t, target.t); };
  if (!is_there && std::any_of(all.begin(), all.end(), leads_there)) return leave_undecided();
  if (!is_there) fail_at(target.cosine, Fault::lost, probe.ray, "not among all hits, expected t " + exact(target.t));
  if (count > 1 && target.cosine > steep_enough && target.is_crossed)
    fail(Fault::duplicate, probe.ray,
         std::to_string(count) + " hits at one place, expected one at t " + exact(target.t));
}

/// The closest hit is the first of all that are ahead; at the interval's beginning rounding decides.
void Check::first(const Ray& ray, const std::optional<Hit>& hit, std::span<const Crossing> all) {
  const auto ahead = std::find_if(all.begin(), all.end(), [&](const Crossing& c) {
    return c.hit.t >= ray.tmin + slack(ray, cosine_of(ray, c.hit)) && c.hit.t <= ray.tmax;
  });
  if (ahead == all.end()) return;
  const double latest = ahead->hit.t + slack(ray, cosine_of(ray, ahead->hit));
  if (hit && hit->t > latest && runs_along(ray, ahead->hit.t, hit->t)) return leave_undecided();
  if (!hit || hit->t > latest)
    fail(Fault::lost, ray,
         "of all hits the first is " + text(ahead->hit) + ", the closest " + (hit ? text(*hit) : "none"));
}

}  // namespace shaolin::stress
