#include "scheme_scene.inl"

namespace shaolin {

template std::unique_ptr<Scene::Implementation> make_scheme_scene(ControlMesh, const RuntimeScheme<FaceKind::quad>&,
                                                                  const SceneOptions&);

}  // namespace shaolin
