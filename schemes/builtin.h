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

/// The masks of the built-in scheme of that name, behind virtual functions. Throws InputError for another name.
std::shared_ptr<const SchemeMasks> builtin_masks(const std::string& name);

/// Calls use(scheme) with the built-in scheme of that name. Loop and Catmull-Clark are types of their own, whose masks
/// are inlined; the others share one type per face kind, so that a program is not compiled once for each. Throws
/// InputError for another name.
template <class Use>
auto with_scheme(const std::string& name, Use use) {
  if (name == Loop::name) return use(Loop());
  if (name == CatmullClark::name) return use(CatmullClark());
  return with_masks(builtin_masks(name), use);
}

}  // namespace shaolin
