#include "validity.h"

#include <stdexcept>

#include "../schemes/builtin.h"
#include "../schemes/scheme_surface.h"

namespace shaolin {

namespace {

/// Adds the counts if the surface is of that scheme.
template <Scheme S>
bool add_counts(const LimitSurface& surface, ValidityCounts& total) {
  const auto* typed = dynamic_cast<const SchemeSurface<S>*>(&surface);
  if (!typed) return false;
  for (int face = 0; face < typed->face_count(); ++face)
    for (int sub = 0; typed->has_limit(face) && sub < typed->sub_count(face); ++sub)
      total += for_each_valid_part(typed->patch(face, sub), [](const ValidPart<S>&) {});
  return true;
}

}  // namespace

ValidityCounts count_valid_parts(const LimitSurface& surface) {
  ValidityCounts total;
  const bool known = add_counts<Loop>(surface, total) || add_counts<CatmullClark>(surface, total) ||
                     add_counts<RuntimeScheme<FaceKind::triangle>>(surface, total) ||
                     add_counts<RuntimeScheme<FaceKind::quad>>(surface, total);
  if (!known) throw std::logic_error("a limit surface of a type that the library does not make");
  return total;
}

}  // namespace shaolin
