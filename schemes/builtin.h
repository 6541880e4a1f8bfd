#pragma once
/// The schemes that come with the library, by name.
#include <span>
#include <string>

#include "catmull_clark.h"
#include "errors.h"
#include "linear.h"
#include "loop.h"
#include "runtime_scheme.h"

namespace shaolin {

/// A built-in scheme: its name, and what to say about it in one line.
struct BuiltinScheme {
  const char* name;
  FaceKind face_kind;
  const char* about;
};

/// loop, catmark, warren, linear, bilinear.
std::span<const BuiltinScheme> builtin_schemes();

/// "loop, catmark, ... or bilinear": for messages.
std::string builtin_scheme_names();

/// Calls use(scheme) with the built-in scheme of that name. Loop and Catmull-Clark are types of their own, whose masks
/// are inlined; the others share one type per face kind, so that a program is not compiled once for each. Throws
/// InputError for another name.
template <class Use>
auto with_scheme(const std::string& name, Use use) {
  using Triangles = RuntimeScheme<FaceKind::triangle>;
  using Quads = RuntimeScheme<FaceKind::quad>;
  if (name == Loop::name) return use(Loop());
  if (name == CatmullClark::name) return use(CatmullClark());
  if (name == Warren::name) return use(Triangles(std::make_shared<MasksOf<Warren>>()));
  if (name == Linear::name) return use(Triangles(std::make_shared<MasksOf<Linear>>()));
  if (name == Bilinear::name) return use(Quads(std::make_shared<MasksOf<Bilinear>>()));
  throw InputError("unknown scheme '" + name + "'; expected " + builtin_scheme_names());
}

}  // namespace shaolin
