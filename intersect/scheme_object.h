#pragma once
/// An Object for one type of scheme. Private to intersect/object*.cpp: each type is compiled in a file of its own.
#include <memory>

#include "../schemes/builtin.h"
#include "object.h"

namespace shaolin {

/// Throws InputError if the mesh does not suit the scheme.
template <Scheme S>
std::shared_ptr<const Object> make_scheme_object(ControlMesh mesh, const S& scheme, const SceneOptions& options);

}  // namespace shaolin
