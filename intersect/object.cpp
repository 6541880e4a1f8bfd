#include "object.h"

#include "scheme_object.h"

namespace shaolin {

namespace {

const SceneOptions& checked(const SceneOptions& options) {
  if (options.method == Method::uniform && (options.level < 1 || options.level > 10))
    throw InputError("tessellation level " + std::to_string(options.level) + " is out of range; expected 1 to 10");
  return options;
}

}  // namespace

std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::string& scheme, const SceneOptions& options) {
  return with_scheme(scheme,
                     [&](const auto& type) { return make_scheme_object(std::move(mesh), type, checked(options)); });
}

std::shared_ptr<const Object> make_object(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks,
                                          const SceneOptions& options) {
  return with_masks(masks,
                    [&](const auto& type) { return make_scheme_object(std::move(mesh), type, checked(options)); });
}

}  // namespace shaolin
