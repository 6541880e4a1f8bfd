#include "builtin.h"

#include <array>

namespace shaolin {

std::span<const BuiltinScheme> builtin_schemes() {
  static constexpr std::array<BuiltinScheme, 5> schemes{{
      {Loop::name, Loop::face_kind, "Loop 1987: box splines on triangles"},
      {CatmullClark::name, CatmullClark::face_kind, "Catmull and Clark 1978: bicubic B-splines on quads and n-gons"},
      {Warren::name, Warren::face_kind, "Loop's scheme with Warren's weights at irregular vertices"},
      {Linear::name, Linear::face_kind, "the triangles themselves"},
      {Bilinear::name, Bilinear::face_kind, "bilinear patches on quads and on the quads of n-gons"},
  }};
  return schemes;
}

std::string builtin_scheme_names() {
  std::string names;
  const auto schemes = builtin_schemes();
  for (const BuiltinScheme& scheme : schemes) {
    if (!names.empty()) names += &scheme == &schemes.back() ? " or " : ", ";
    names += scheme.name;
  }
  return names;
}

std::shared_ptr<const SchemeMasks> builtin_masks(const std::string& name) {
  if (name == Loop::name) return std::make_shared<MasksOf<Loop>>();
  if (name == CatmullClark::name) return std::make_shared<MasksOf<CatmullClark>>();
  if (name == Warren::name) return std::make_shared<MasksOf<Warren>>();
  if (name == Linear::name) return std::make_shared<MasksOf<Linear>>();
  if (name == Bilinear::name) return std::make_shared<MasksOf<Bilinear>>();
  throw InputError("unknown scheme '" + name + "'; expected " + builtin_scheme_names());
}

}  // namespace shaolin
