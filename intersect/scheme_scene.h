#pragma once
/// A Scene for one type of scheme. Private to intersect/scene*.cpp: each type is compiled in a file of its own.
#include <memory>

#include "../schemes/builtin.h"
#include "scene.h"

namespace shaolin {

/// The surface and its intersector behind the scheme's type.
class Scene::Implementation {
 public:
  virtual ~Implementation() = default;
  virtual std::optional<Hit> intersect(const Ray& ray) const = 0;
  virtual bool occluded(const Ray& ray) const = 0;
  virtual const LimitSurface& surface() const = 0;
  virtual Statistics statistics() const = 0;
  virtual Box bounds() const = 0;
};

/// Throws InputError if the mesh does not suit the scheme.
template <Scheme S>
std::unique_ptr<Scene::Implementation> make_scheme_scene(ControlMesh mesh, const S& scheme,
                                                         const SceneOptions& options);

}  // namespace shaolin
