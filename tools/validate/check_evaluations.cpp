#include "tools/validate/check_evaluations.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shaolin {
namespace {

/// Errors with the parameters they belong to.
class Collector {
 public:
  void add(double error, const SurfaceParameter& at) {
    errors_.push_back(error);
    places_.push_back(at);
  }
  SampledErrors result() const {
    SampledErrors errors{summarize(errors_), {}};
    if (!places_.empty()) errors.worst = places_[errors.summary.worst];
    return errors;
  }

 private:
  std::vector<double> errors_;
  std::vector<SurfaceParameter> places_;
};

double corner_distance(const SurfaceParameter& at, bool triangular) {
  if (triangular) return 1 - std::max({1 - at.u - at.v, at.u, at.v});
  return std::max(std::min(at.u, 1 - at.u), std::min(at.v, 1 - at.v));
}

/// Not at a corner, but close to it: what is continuous there has changed by little.
constexpr double step_inwards = 0x1p-20, limit_tolerance = 0x1p-10;

SurfaceParameter inwards(SurfaceParameter at) {
  at.u += step_inwards * (0.3125 - at.u);
  at.v += step_inwards * (0.3125 - at.v);
  return at;
}

std::string text(const Derivatives& d) {
  return "du " + exact(d.du) + " dv " + exact(d.dv) + " duu " + exact(d.duu) + " duv " + exact(d.duv) + " dvv " +
         exact(d.dvv);
}

class EvaluationCheck {
 public:
  EvaluationCheck(const Evaluator& ours, const Oracle& oracle) : ours_(ours), oracle_(oracle) {}

  void face(int f);
  void parameter(const SurfaceParameter& at);
  EvaluationReport report() const;

 private:
  void disagree(const char* what, const SurfaceParameter& at, std::string detail, double error, double allowed) {
    report_.disagreements.push_back({what, at, {}, std::move(detail), error, allowed});
  }
  void position(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs);
  void normal(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs);
  void derivatives(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs);

  const Evaluator& ours_;
  const Oracle& oracle_;
  EvaluationReport report_;
  Collector positions_, normals_, undetermined_, derivatives_;
};

void EvaluationCheck::face(int f) {
  ++report_.faces;
  const SurfaceParameter centre{f, 0, 0.3125, 0.3125};
  const bool expected = oracle_.has_limit(f);
  report_.faces_without_limit += !expected;
  if (ours_.has_limit(f) != expected) {
    disagree("has_limit", centre, expected ? "ours false, oracle true" : "ours true, oracle false", 1, 0);
  }
  if (ours_.sub_count(f) != oracle_.sub_count(f)) {
    disagree("sub_count", centre,
             "ours " + std::to_string(ours_.sub_count(f)) + ", oracle " + std::to_string(oracle_.sub_count(f)), 1, 0);
  } else if (ours_.evaluate(centre).has_value() != expected) {
    disagree("evaluation", centre, expected ? "ours is empty" : "ours has a value where the oracle has no limit", 1, 0);
  }
}

void EvaluationCheck::parameter(const SurfaceParameter& at) {
  ++report_.evaluations;
  const std::optional<LimitSample> ours = ours_.evaluate(at), theirs = oracle_.evaluate(at);
  if (!ours || !theirs) {
    if (ours.has_value() != theirs.has_value()) {
      disagree("evaluation", at, ours ? "ours has a value where the oracle has none" : "ours is empty", 1, 0);
    }
    return;
  }
  position(at, *ours, *theirs);
  normal(at, *ours, *theirs);
  if (oracle_.has_derivatives()) derivatives(at, *ours, *theirs);
}

void EvaluationCheck::position(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs) {
  const double error = (ours.position - theirs.position).norm() / oracle_.diagonal();
  positions_.add(error, at);
  if (!(error <= bar::position_max)) {
    disagree("position", at, "ours " + exact(ours.position) + ", oracle " + exact(theirs.position), error,
             bar::position_max);
  }
}

void EvaluationCheck::normal(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs) {
  const double error = angle_between_units(ours.normal, theirs.normal);
  if (!has_determined_normal(theirs)) {
    undetermined_.add(error, at);
    return;
  }
  normals_.add(error, at);
  if (!(error <= bar::normal)) {
    disagree("normal", at,
             "ours " + exact(ours.normal) + ", oracle " + exact(theirs.normal) + " (determined to " +
                 exact(normal_uncertainty(theirs)) + " rad)",
             error, bar::normal);
  }
}

/// The oracle gives no derivatives at any vertex that is irregular in the mesh; a single face of it may be a regular
/// piece there all the same (a face between two creases). Then ours must be the limit of the oracle's.
void EvaluationCheck::derivatives(const SurfaceParameter& at, const LimitSample& ours, const LimitSample& theirs) {
  if (!ours.derivatives && theirs.derivatives) disagree("derivatives", at, "ours has none, the oracle some", 1, 0);
  if (!ours.derivatives) return;
  const bool beside = !theirs.derivatives;
  const Derivatives expected = beside ? *oracle_.evaluate(inwards(at))->derivatives : *theirs.derivatives;
  const double distance = beside ? 1 : corner_distance(at, oracle_.triangular());
  const double error = derivative_error(*ours.derivatives, expected, distance);
  const double allowed = beside ? limit_tolerance : bar::derivative;
  if (!beside) derivatives_.add(error, at);
  if (error <= allowed) return;
  disagree("derivatives", at, "ours " + text(*ours.derivatives) + ", oracle " + text(expected), error, allowed);
}

EvaluationReport EvaluationCheck::report() const {
  EvaluationReport report = report_;
  report.positions = positions_.result();
  report.normals = normals_.result();
  report.undetermined_normals = undetermined_.result();
  report.derivatives = derivatives_.result();
  return report;
}

}  // namespace

Evaluator Evaluator::of(const LimitSurface& surface) {
  return {[&](int face) { return surface.sub_count(face); }, [&](int face) { return surface.has_limit(face); },
          [&](const SurfaceParameter& at) { return surface.evaluate(at); }};
}

EvaluationReport check_evaluations(const Evaluator& ours, const Oracle& oracle,
                                   std::span<const SurfaceParameter> parameters) {
  EvaluationCheck check(ours, oracle);
  for (int f = 0; f < oracle.face_count(); ++f) check.face(f);
  for (const SurfaceParameter& at : parameters) check.parameter(at);
  return check.report();
}

}  // namespace shaolin
