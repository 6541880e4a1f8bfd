// object_loop.cpp again, for AVX2; see object_avx2.h.
#include "object_avx2.h"
#include "scheme_object.inl"

namespace shaolin::avx2 {

std::shared_ptr<const Object> make_object(ControlMesh mesh, const Loop& scheme, const SceneOptions& options) {
  return make_scheme_object(std::move(mesh), scheme, options);
}

}  // namespace shaolin::avx2
