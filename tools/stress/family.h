#pragma once
/// Families of rays: each a way in which ray tracers lose hits.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/stress/check.h"

namespace shaolin::stress {

/// One family at one model, ready for rays.
class Stage {
 public:
  virtual ~Stage() = default;

  /// Draws one ray, checks its answers and adds them to the tally. May be called from several threads at once; what it
  /// does depends on the random numbers alone.
  virtual void shoot(SampleRandom& random, Tally& tally) const = 0;
};

struct Family {
  std::string name;
  std::string meaning;  ///< of its rays, for people
  /// Null where the model has nothing for the family to aim at. Throws InputError as Scene does.
  std::function<std::unique_ptr<const Stage>(const StressModel&, const QueriesOf&)> stage;
  /// The meshes made by code that it is for; null: the user's models.
  std::function<std::vector<StressModel>()> own_models = nullptr;
};

/// All of them, in the order of the tables.
const std::vector<Family>& families();

// By file.
std::vector<Family> aimed_families();       ///< at vertices, edges, creases, extraordinary points, and an ulp beside
std::vector<Family> parity_families();      ///< random lines, and what origins inside and outside see
std::vector<Family> grazing_families();     ///< grazing, tangent, along isoparametric lines, silhouettes
std::vector<Family> moved_families();       ///< translated, scaled, rotated, from afar
std::vector<Family> watertight_families();  ///< Embree's sphere, from inside
std::vector<Family> degenerate_families();  ///< degenerate meshes, all sharpnesses and valences
std::vector<Family> invariance_families();  ///< permuted, mirrored
std::vector<Family> spawned_families();     ///< rays from hits
std::vector<Family> bad_number_families();  ///< NaN, infinity, denormal, zero

/// A stage whose rays are drawn by a function from one subject, and checked by Check::ray().
std::unique_ptr<const Stage> probe_stage(std::string family, std::vector<std::unique_ptr<const Subject>> subjects,
                                         std::function<Probe(const Subject&, SampleRandom&)> draw);
std::unique_ptr<const Stage> probe_stage(std::string family, std::unique_ptr<const Subject> subject,
                                         std::function<Probe(const Subject&, SampleRandom&)> draw);

}  // namespace shaolin::stress
