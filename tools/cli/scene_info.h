#pragma once
/// What `shaolin info` says of a scene file.
#include "tools/cli/model.h"

namespace shaolin {

/// Prints objects, instances and control faces to stdout. Throws InputError for bad input. Returns exit_done.
int scene_info(const ModelOptions& options);

}  // namespace shaolin
