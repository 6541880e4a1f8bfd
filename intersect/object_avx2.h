#pragma once
/// make_scheme_object(), compiled for AVX2. Private to intersect/object*.cpp.
#include <memory>

#include "../schemes/builtin.h"
#include "object.h"

namespace shaolin::avx2 {

/// For processors that run it (instruction_set.h). They throw as make_scheme_object() does.
std::shared_ptr<const Object> make_object(ControlMesh mesh, const Loop& scheme, const SceneOptions& options);
std::shared_ptr<const Object> make_object(ControlMesh mesh, const CatmullClark& scheme, const SceneOptions& options);

}  // namespace shaolin::avx2
