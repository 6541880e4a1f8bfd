#pragma once
/// From the MODEL of `render`, `query` and `info` to a scene: a model stands alone, a scene file holds many.
#include <string>
#include <vector>

#include "intersect/scene.h"
#include "tools/cli/model.h"
#include "tools/cli/scene_file.h"

namespace shaolin {

/// The models of a scene, read, and where they stand.
struct Stage {
  std::string file;       ///< the MODEL, for messages
  bool is_scene = false;  ///< a scene file; else a model, which is one object under the identity
  SceneFile scene;
  std::vector<LoadedModel> models;  ///< of scene.objects

  /// The schemes of the models, each once: "catmark, loop".
  std::string schemes() const;
};

/// Adds the options of a model for a subcommand that takes scene files, too.
void add_stage_options(CLI::App& app, ModelOptions& options);

/// Reads everything. --scheme and --plugin overrule what a scene file says, for all its objects. Throws InputError;
/// what is wrong with a model of a scene names the place in the scene file, too.
Stage load_stage(const ModelOptions& options);

/// Builds what stands in the scene, each object once, and empties stage.models. Throws InputError as load_stage() does.
Scene build_scene(Stage& stage, const SceneOptions& options = {});

}  // namespace shaolin
