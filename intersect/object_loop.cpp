#include "scheme_object.inl"

namespace shaolin {

template std::shared_ptr<const Object> make_scheme_object(ControlMesh, const Loop&, const SceneOptions&);

}  // namespace shaolin
