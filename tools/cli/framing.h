#pragma once
/// Where a picture is seen from if nobody says.
#include "tools/cli/camera.h"
#include "tools/cli/stage.h"

namespace shaolin {

/// The scene file's camera, or one that frames all that is built. Throws InputError if there is nothing to frame.
Camera choose_camera(const Stage& stage, const Scene& scene, ImageSize size);

}  // namespace shaolin
