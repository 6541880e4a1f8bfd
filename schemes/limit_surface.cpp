#include "limit_surface.h"

#include "builtin.h"
#include "scheme_surface.h"

namespace shaolin {

std::string default_scheme(const ControlMesh& mesh) {
  if (!mesh.scheme.empty()) return mesh.scheme;
  return mesh.all_triangles() ? Loop::name : CatmullClark::name;
}

std::unique_ptr<LimitSurface> make_limit_surface(ControlMesh mesh, const std::string& scheme) {
  return with_scheme(scheme, [&]<Scheme S>(const S& type) -> std::unique_ptr<LimitSurface> {
    return std::make_unique<SchemeSurface<S>>(std::move(mesh), type);
  });
}

}  // namespace shaolin
