#include "limit_surface.h"

#include "builtin.h"
#include "scheme_surface.h"

namespace shaolin {

namespace {

/// Makes the surface of a mesh by the scheme that it is called with, once: the mesh moves on.
struct SurfaceOf {
  ControlMesh& mesh;

  template <Scheme S>
  std::unique_ptr<LimitSurface> operator()(const S& scheme) const {
    return std::make_unique<SchemeSurface<S>>(std::move(mesh), scheme);
  }
};

}  // namespace

std::string default_scheme(const ControlMesh& mesh) {
  if (!mesh.scheme.empty()) return mesh.scheme;
  return mesh.all_triangles() ? Loop::name : CatmullClark::name;
}

std::unique_ptr<LimitSurface> make_limit_surface(ControlMesh mesh, const std::string& scheme) {
  return with_scheme(scheme, SurfaceOf{mesh});
}

std::unique_ptr<LimitSurface> make_limit_surface(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks) {
  return with_masks(masks, SurfaceOf{mesh});
}

}  // namespace shaolin
