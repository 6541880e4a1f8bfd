#pragma once
/// make_scheme_object(), compiled for AVX2. Private to intersect/object*.cpp.
///
/// All that object_*_avx2.cpp define, but for these functions, is made local to them (CMakeLists.txt): an inline function
/// that other files compile, too, must not be taken from there on processors without AVX2.
#include <memory>

#include "../schemes/builtin.h"
#include "object.h"

namespace shaolin::avx2 {

/// For processors that run it (instruction_set.h). They throw as make_scheme_object() does.
std::shared_ptr<const Object> make_object(ControlMesh mesh, const Loop& scheme, const SceneOptions& options);
std::shared_ptr<const Object> make_object(ControlMesh mesh, const CatmullClark& scheme, const SceneOptions& options);

}  // namespace shaolin::avx2
