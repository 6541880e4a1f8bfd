#include "scene.h"

#include "scheme_scene.h"

namespace shaolin {

namespace {

const SceneOptions& checked(const SceneOptions& options) {
  if (options.method == Method::uniform && (options.level < 1 || options.level > 10))
    throw InputError("tessellation level " + std::to_string(options.level) + " is out of range; expected 1 to 10");
  return options;
}

}  // namespace

Scene::Scene(ControlMesh mesh, const std::string& scheme, const SceneOptions& options)
    : implementation_(with_scheme(
          scheme, [&](const auto& type) { return make_scheme_scene(std::move(mesh), type, checked(options)); })) {}
Scene::Scene(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks, const SceneOptions& options)
    : implementation_(with_masks(
          masks, [&](const auto& type) { return make_scheme_scene(std::move(mesh), type, checked(options)); })) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<Hit> Scene::intersect(const Ray& ray) const { return implementation_->intersect(ray); }
bool Scene::occluded(const Ray& ray) const { return implementation_->occluded(ray); }
const LimitSurface& Scene::surface() const { return implementation_->surface(); }
Statistics Scene::statistics() const { return implementation_->statistics(); }

Box Scene::bounds() const { return implementation_->bounds(); }

}  // namespace shaolin
