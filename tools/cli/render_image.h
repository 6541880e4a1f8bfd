#pragma once
/// From a scene and a view to an image.
#include "intersect/scene.h"
#include "tools/cli/image.h"
#include "tools/cli/look.h"

namespace shaolin {

/// One ray and its shading per pixel, in parallel; `options` are those of the scene's objects. The image does not
/// depend on the number of threads. Throws what the scene's queries throw.
Image render_image(const Scene& scene, const View& view, const Look& look, const SceneOptions& options = {});

}  // namespace shaolin
