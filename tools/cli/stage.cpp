#include "tools/cli/stage.h"

#include <set>
#include <utility>

#include "schemes/errors.h"

namespace shaolin {
namespace {

/// Calls act() for an object of a scene; its errors get the place in the scene file.
template <class Act>
auto at_place(const std::string& file, const std::string& place, Act act) {
  try {
    return act();
  } catch (const InputError& error) {
    if (place.empty()) throw;
    throw InputError(place + ": " + error.what(), file);
  }
}

}  // namespace

std::string Stage::schemes() const {
  std::set<std::string> names;
  for (const LoadedModel& model : models) names.insert(model.scheme);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

void add_stage_options(CLI::App& app, ModelOptions& options) {
  add_model_options(app, options,
                    "The control mesh: an OBJ file with OpenSubdiv's tag lines; or a scene, a .json file (see "
                    "docs/scenes.md), all of whose objects --scheme and --plugin are for");
}

Stage load_stage(const ModelOptions& options) {
  Stage stage;
  stage.file = options.file.string();
  stage.is_scene = is_scene_file(options.file);
  if (!stage.is_scene) {
    stage.models.push_back(load_model(options));
    stage.scene.objects.push_back({options.file.stem().string(), options.file, options.scheme, {}});
    stage.scene.instances.push_back({0, Affine::Identity()});
    return stage;
  }
  stage.scene = read_scene_file(options.file);
  for (const SceneFile::Object& object : stage.scene.objects)
    stage.models.push_back(at_place(stage.scene.file, object.place, [&] {
      return load_model({object.model, options.scheme.empty() ? object.scheme : options.scheme, options.plugin});
    }));
  return stage;
}

Scene build_scene(Stage& stage, const SceneOptions& options) {
  std::vector<std::shared_ptr<const Object>> objects(stage.models.size());
  std::vector<Instance> instances;
  instances.reserve(stage.scene.instances.size());
  for (const SceneFile::Instance& instance : stage.scene.instances) {
    std::shared_ptr<const Object>& object = objects[instance.object];
    if (!object)
      object = at_place(stage.scene.file, stage.scene.objects[instance.object].place,
                        [&] { return build_object(std::move(stage.models[instance.object]), options); });
    instances.push_back({object, instance.transform});
  }
  stage.models.clear();
  return Scene(std::move(instances));
}

}  // namespace shaolin
