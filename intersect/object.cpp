#include "object.h"

#include <sstream>

#include "instruction_set.h"
#include "object_avx2.h"
#include "scheme_object.h"

namespace shaolin {

namespace {

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// (Written so that a NaN fails.)
void check(const ChordOptions& options) {
  if (!(options.epsilon > 0))
    throw InputError("epsilon " + text(options.epsilon) + " is out of range; expected a positive length");
  if (!(options.min_size >= 0 && options.max_size >= options.min_size))
    throw InputError("sizes " + text(options.min_size) + " and " + text(options.max_size) +
                     " are out of range; expected 0 <= min_size <= max_size");
}

const SceneOptions& checked(const SceneOptions& options) {
  if (options.method == Method::uniform && (options.level < 1 || options.level > 10))
    throw InputError("tessellation level " + std::to_string(options.level) + " is out of range; expected 1 to 10");
  if (options.method == Method::uniform && options.budget)
    throw InputError("a tessellation takes no memory budget; expected another method, or none");
  if (options.method == Method::chord || options.method == Method::a3) check(options.chord);
  return options;
}

}  // namespace

std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::string& scheme, const SceneOptions& options) {
  [[maybe_unused]] const InstructionSet set = instruction_set();
  return with_scheme(scheme, [&](const auto& type) {
#ifdef SHAOLIN_HAS_AVX2
    if constexpr (requires { avx2::make_object(std::move(mesh), type, options); })
      if (set == InstructionSet::avx2) return avx2::make_object(std::move(mesh), type, checked(options));
#endif
    return make_scheme_object(std::move(mesh), type, checked(options));
  });
}

std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks,
                                          const SceneOptions& options) {
  return with_masks(masks,
                    [&](const auto& type) { return make_scheme_object(std::move(mesh), type, checked(options)); });
}

}  // namespace shaolin
