#pragma once
/// The conformance kit: is a scheme what its author says?
#include <memory>
#include <string>
#include <vector>

#include "schemes/runtime_scheme.h"
#include "tools/conformance/characteristic_map.h"

namespace shaolin {

/// What a check came to. A finding is a known property of published rules that the author should know of; it is no
/// failure.
enum class Verdict { pass, finding, fail };

struct CheckResult {
  std::string name;     ///< "limit masks"
  std::string subject;  ///< where the worst figure was seen: "crease of 7 faces"
  double figure = 0;
  double bar = 0;  ///< the figure must not be larger
  Verdict verdict = Verdict::pass;
  std::string note;  ///< what it means, for a finding or a failure
};

/// The eigenvalues of the subdivision matrix at a vertex.
struct SpectrumRow {
  StarKind kind;
  int faces;
  std::vector<double> moduli;  ///< largest first, at most six
};

struct ConformanceReport {
  std::string scheme;
  FaceKind face_kind;
  std::vector<CheckResult> checks;
  std::vector<SpectrumRow> spectra;
  std::vector<CharacteristicMap> maps;  ///< of smooth vertices, valence 3 to 12

  bool passed() const;
};

/// Runs every check on a scheme: 3 to `most_faces` faces around smooth and dart vertices, 1 to 12 in sectors of creases
/// and corners. Deterministic. Takes seconds, and the fourth power of `most_faces` from there.
ConformanceReport check_conformance(const std::string& name, const std::shared_ptr<const SchemeMasks>& masks,
                                    int most_faces = 40);

}  // namespace shaolin
