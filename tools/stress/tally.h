#pragma once
/// What came of the rays of one family at one model.
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "intersect/ray.h"
#include "schemes/control_mesh.h"
#include "tools/stress/unproven.h"

namespace shaolin::stress {

enum class Fault {
  lost,      ///< a hit that must be there is not, or a farther one was reported
  ghost,     ///< a hit that is off the surface, off the ray or out of the interval; an answer where none is defined
  duplicate  ///< one crossing was reported more than once
};
inline constexpr std::array<Fault, 3> faults{Fault::lost, Fault::ghost, Fault::duplicate};
const char* name_of(Fault fault);

/// A ray that was answered wrongly, with all that it takes to ask it again.
struct Failure {
  Fault fault;
  std::string family, model;
  std::string variant;  ///< what was done to the model, empty: nothing
  std::string detail;   ///< what was found, what was expected
  Ray ray;
};

/// Sums and maxima, so that the order in which parts are added does not show.
struct Tally {
  std::size_t rays = 0;
  std::size_t hits = 0;                ///< closest hits
  std::array<std::size_t, 3> wrong{};  ///< rays with such a fault, in the order of `faults`
  std::size_t undecided = 0;           ///< rays of which all hits do not add up, but graze: see check.h
  std::size_t certified = 0;           ///< hits that carry a certificate, or that Scene::certify() gives one
  std::array<std::size_t, unproven_count> uncertified{};  ///< all other hits, in the order of Unproven
  double worst_error = 0;         ///< of positions, in units of the last place of the coordinates, see check.h
  std::vector<Failure> failures;  ///< the first `most_failures` of a model and family
  static constexpr std::size_t most_failures = 1000;

  void add(const Tally& other);
  void fail(Failure failure);
  std::size_t count(Fault fault) const { return wrong[static_cast<std::size_t>(fault)]; }
  bool passed() const { return wrong == std::array<std::size_t, 3>{}; }
  std::size_t count(Unproven why) const { return uncertified[static_cast<std::size_t>(why)]; }
  /// Of the hits that were asked for a certificate, the share that has none; empty where none was.
  std::optional<double> uncertified_share() const;
};

}  // namespace shaolin::stress
