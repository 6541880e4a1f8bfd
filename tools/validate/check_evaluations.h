#pragma once
/// Evaluation held against the oracle.
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "schemes/limit_surface.h"
#include "tools/validate/agreement.h"
#include "tools/validate/oracle.h"

namespace shaolin {

/// The party that is checked; LimitSurface's functions of these names.
struct Evaluator {
  std::function<int(int face)> sub_count;
  std::function<bool(int face)> has_limit;
  std::function<std::optional<LimitSample>(const SurfaceParameter&)> evaluate;

  static Evaluator of(const LimitSurface& surface);
};

/// Errors of one kind over all samples that have it, and where the largest is.
struct SampledErrors {
  ErrorSummary summary;
  SurfaceParameter worst;
};

struct EvaluationReport {
  std::size_t evaluations = 0;
  int faces = 0, faces_without_limit = 0;
  SampledErrors positions;             ///< in diagonals
  SampledErrors normals;               ///< rad, where double precision determines them
  SampledErrors undetermined_normals;  ///< rad, where it does not: counted, not judged
  SampledErrors derivatives;           ///< relative, see derivative_error()
  std::vector<Disagreement> disagreements;

  bool median_passes() const { return positions.summary.median <= bar::position_median; }
  bool p99_passes() const { return positions.summary.p99 <= bar::position_p99; }
  bool passed() const { return disagreements.empty() && median_passes() && p99_passes(); }
};

/// Every face: has it a limit surface, how many subs, and is its evaluation empty exactly where the oracle has no
/// limit? Then every parameter, which must lie on faces with a limit surface. O(faces + parameters).
EvaluationReport check_evaluations(const Evaluator& ours, const Oracle& oracle,
                                   std::span<const SurfaceParameter> parameters);

}  // namespace shaolin
