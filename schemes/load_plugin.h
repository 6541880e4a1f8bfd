#pragma once
/// Schemes from shared libraries.
#include <filesystem>
#include <memory>
#include <string>

#include "runtime_scheme.h"

namespace shaolin {

/// A scheme from a shared library, which stays loaded as long as the masks live.
struct LoadedPlugin {
  std::string name;
  std::shared_ptr<const SchemeMasks> masks;
  bool has_crease = false;  ///< its author gave weights for creases; else they are cubic_crease
};

/// Loads a library made by SHAOLIN_SCHEME_PLUGIN (see plugin.h), or by hand in C (see plugin_abi.h), and asks it for
/// its masks at valences 3 to 8. This runs code of the library. Throws InputError if the file is missing or no shared
/// library, has no entry point or another version's, if a field is missing or makes no sense, and if one of the masks
/// fails. Masks that are asked for later throw InputError, too, if they fail or are not the expected number of finite
/// weights.
LoadedPlugin load_plugin(const std::filesystem::path& file);

}  // namespace shaolin
