#include "scene.h"

#include "scheme_scene.h"

namespace shaolin {

Scene::Scene(ControlMesh mesh, const std::string& scheme)
    : implementation_(with_scheme(scheme, [&](const auto& type) { return make_scheme_scene(std::move(mesh), type); })) {
}
Scene::Scene(ControlMesh mesh, const std::shared_ptr<const SchemeMasks>& masks)
    : implementation_(with_masks(masks, [&](const auto& type) { return make_scheme_scene(std::move(mesh), type); })) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::optional<Hit> Scene::intersect(const Ray& ray) const { return implementation_->intersect(ray); }
bool Scene::occluded(const Ray& ray) const { return implementation_->occluded(ray); }
const LimitSurface& Scene::surface() const { return implementation_->surface(); }
Statistics Scene::statistics() const { return implementation_->statistics(); }

Box Scene::bounds() const { return implementation_->bounds(); }

}  // namespace shaolin
