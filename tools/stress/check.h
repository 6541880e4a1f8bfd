#pragma once
/// What must be true of a ray's answers, and what is counted where it is not.
#include <span>
#include <string>
#include <vector>

#include "tools/stress/aim.h"
#include "tools/stress/tally.h"

namespace shaolin::stress {

/// Checks of one subject's rays, each added to a tally under the family's name.
///
/// A hit is sound if the surface, evaluated at its (face, sub, u, v) or a unit of a parameter's last place beside, is
/// where the ray is at its t and where its sample says, if t lies in the interval, the parameter in its domain, and the
/// normal is unit or none. A position's error is the larger of those two distances, and counts in units of the last
/// place of Subject::magnitude().
class Check {
 public:
  Check(const Subject& subject, std::string family, Tally& tally)
      : subject_(subject), family_(std::move(family)), tally_(tally) {}

  /// The closest hit, any hit and all hits of one ray:
  /// - with a target there is a hit there or before it (else: lost), and one of all hits is there, exactly one where
  /// the
  ///   ray crosses the surface at more than 0.1 rad (else: duplicate);
  /// - the first of all hits that lie ahead is the closest;
  /// - every hit is sound, all of them are in order, and no query throws (else: ghost);
  /// - of a closed surface, entering and leaving along the whole line cancel (else: lost, or duplicate where two in
  ///   succession at one place go the same way).
  /// At most one fault of each kind counts for a ray. What all hits say of places where the ray grazes the surface at
  /// less than Subject::grazing() counts as undecided: there one and the same double root may be found as two
  /// crossings, as a touch or as something between.
  void ray(const Probe& probe);

  /// The sum of the senses of sound hits of a ray: the winding number of its origin, if the surface is closed.
  int winding(const Ray& ray);
  /// The same of hits that are known.
  static int winding(std::span<const Crossing> all);

  /// Looks at a closest hit alone: whether it is sound; counts it.
  bool hit(const Ray& ray, const Hit& hit);

  void fail(Fault fault, const Ray& ray, std::string detail);
  /// The same where it is a matter of all hits at a cosine: below Subject::grazing() it counts as undecided.
  void fail_at(double cosine, Fault fault, const Ray& ray, std::string detail);

  /// How far off, in t, a hit may be that the ray meets at a cosine: four times the bound of rounding (twice for the
  /// surface's place, twice for the ray's, see contact_uncertainty()) over the cosine. Where that is below 1e-6
  /// rounding decides the angle itself (crossings.cpp).
  double slack(const Ray& ray, double cosine) const;

 private:
  void answers(const Probe& probe);
  std::string unsound(const Ray& ray, const Hit& hit);
  double resolution(const SurfaceParameter& at) const;
  /// True if the ray stays on the surface from one t to another, as far as rounding can tell: of a flat face seen at
  /// less than 1e-6 any place there is as good.
  bool runs_along(const Ray& ray, double from, double to) const;
  void leave_undecided();
  void all(const Probe& probe, std::span<const Crossing> all);
  void target(const Probe& probe, std::span<const Crossing> all);
  void first(const Ray& ray, const std::optional<Hit>& hit, std::span<const Crossing> all);

  const Subject& subject_;
  std::string family_;
  Tally& tally_;
  std::array<bool, 3> failed_{};  ///< by the ray that is looked at
  bool undecided_ = false;        ///< the same
};

/// One ray, t and position of a hit, with 17 digits.
std::string text(const Hit& hit);

}  // namespace shaolin::stress
