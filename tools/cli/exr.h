#pragma once
/// Rendered images as OpenEXR files.
#include <filesystem>
#include <string>

#include "tools/cli/image.h"

namespace shaolin {

/// What the header says about the image, beside its channels.
struct ExrNotes {
  std::string camera;  ///< as --camera takes it
  std::string scheme;
  bool instances = false;  ///< the image is of a scene file: it gets the channel `instance`
};

/// Writes a scan-line file with ZIP compression and the channels
///
///     R G B A        FLOAT  beauty, linear; 0 on a miss, or the background with A = 1
///     Z              FLOAT  distance from the eye; +infinity on a miss
///     N.X N.Y N.Z    FLOAT  unit limit normal, along du x dv; 0 on a miss
///     P.X P.Y P.Z    FLOAT  limit position; 0 on a miss
///     uv.U uv.V      FLOAT  parameters; 0 on a miss
///     face level     UINT   control face and refinement level; 4294967295 on a miss
///     instance       UINT   of scene files: which instance; 4294967295 on a miss
///
/// (a FLOAT cannot hold every id above 2^24, so ids are UINT). The header gets the string attributes `camera` and
/// `scheme`. `threads` compress. Throws std::exception if the file cannot be written.
void write_exr(const std::filesystem::path& file, const Image& image, const ExrNotes& notes, int threads);

}  // namespace shaolin
