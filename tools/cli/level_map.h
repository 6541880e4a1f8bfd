#pragma once
/// The picture that shows where the surface was refined, and how deep.
#include "tools/cli/camera.h"
#include "tools/cli/image.h"
#include "tools/cli/png.h"

namespace shaolin {

/// The colour of a refinement level in a map whose deepest level is `deepest`: from dark violet over green to light
/// yellow, with lightness (OKLab) that grows evenly, so that deeper always looks lighter.
LinearColor level_color(int level, int deepest);

/// The image with one colour per refinement level, faintly shaded by the angle between the normal and the line of
/// sight; a light grey background; and a legend on the right, beside the image: each level with its colour and its
/// number of pixels. The picture's left image.size.width columns and upper image.size.height rows are the image's
/// pixels. `deepest` is the level that the colours end at, so that maps can be compared: at least the image's deepest,
/// which it is by default.
Picture level_map(const Image& image, const View& view, int deepest = 0);

}  // namespace shaolin
