// The objects of Loop and Catmull-Clark again, compiled for AVX2. All that this file defines, but for the functions of
// avx2, is made local to it (CMakeLists.txt): an inline function that other files compile, too, must not be taken from
// here on processors without AVX2.
#include "object_avx2.h"

#include "scheme_object.inl"

namespace shaolin::avx2 {

std::shared_ptr<const Object> make_object(ControlMesh mesh, const Loop& scheme, const SceneOptions& options) {
  return make_scheme_object(std::move(mesh), scheme, options);
}

std::shared_ptr<const Object> make_object(ControlMesh mesh, const CatmullClark& scheme, const SceneOptions& options) {
  return make_scheme_object(std::move(mesh), scheme, options);
}

}  // namespace shaolin::avx2
