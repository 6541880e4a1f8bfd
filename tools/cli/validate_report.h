#pragma once
/// What `shaolin validate` found, for people and for programs.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "tools/validate/check_evaluations.h"
#include "tools/validate/check_rays.h"
#include "tools/validate/exact_hits.h"
#include "tools/validate/exact_triangles.h"

namespace shaolin {

struct Validation {
  std::string model, scheme;
  std::string oracle;  ///< what the surface was held against
  std::uint64_t seed = 1;
  double diagonal = 0;  ///< of the control mesh's bounding box
  int dense_level = 0;  ///< the dense check's grid has 2^level steps a side; 0: there is none
  double seconds = 0;
  EvaluationReport evaluations{};
  RayReport rays{};
  std::optional<ExactHitFigures> exact_hits{};            ///< if asked for
  std::optional<ExactTriangleFigures> exact_triangles{};  ///< the same, at exact_level
  std::string no_triangles{};                             ///< why there are none, if so

  /// Refinements of the triangles that are decided exactly: chords of Method::uniform.
  static constexpr int exact_level = 2;

  bool passed() const {
    return evaluations.passed() && rays.passed() && (!exact_hits || exact_hits->disagreements.empty()) &&
           (!exact_triangles || exact_triangles->disagreements.empty());
  }
};

/// The table, the first disagreements in full, the verdict: to stdout.
void print_validation(const Validation& validation);

/// Writes a JSON object:
///
///     model, scheme, oracle, seed, diagonal, dense_level, seconds, passed
///     evaluations    { count, faces, faces_without_limit, passed, position, normal, undetermined_normal, derivative }:
///                    the last four are { count, median, p99, max, worst: { face, sub, u, v } }
///     rays           { camera, incoherent, grazing, aimed, all }: every field of RayFigures
///     exact_hits, exact_triangles   every field of ExactHitFigures and ExactTriangleFigures, if asked for;
///     no_triangles bars           the figures that these are held to disagreements  a list of { what, error, allowed,
///     at or ray, replay, detail }: `replay` is a row for
///                    `shaolin eval` or `shaolin query`
///
/// What is not finite is written as the text "infinite". Throws std::runtime_error if the file cannot be written.
void write_validation(const std::filesystem::path& file, const Validation& validation);

}  // namespace shaolin
