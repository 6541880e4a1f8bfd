#pragma once
/// Scene files: objects, and where they stand; docs/scenes.md describes them.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "intersect/affine.h"
#include "tools/cli/camera.h"
#include "tools/cli/look.h"

namespace shaolin {

/// A scene file as read. Groups are dissolved: what is left are meshes and their instances.
struct SceneFile {
  struct Object {
    std::string name;             ///< its key in the file
    std::filesystem::path model;  ///< its mesh's file
    std::string scheme;           ///< a built-in one; empty: what the mesh asks for
    std::string place;            ///< where the model is named, as a JSON path
  };
  struct Instance {
    std::size_t object;
    Affine transform;
  };

  std::string file;                 ///< its name, for messages
  std::vector<Object> objects;      ///< in the file's order
  std::vector<Instance> instances;  ///< in the file's order, a group's in its place
  Look look;                        ///< look.of_instance has an entry for each instance
  std::optional<Camera> camera;
};

/// The most instances that a scene may have, those of groups and the groups' own together.
inline constexpr std::size_t most_instances = 10'000'000;

/// True if the name ends in .json.
bool is_scene_file(const std::filesystem::path& file);

/// Throws InputError with file and JSON path for what is unknown, missing, of the wrong kind or out of range; for
/// groups that contain themselves, and for transforms that inverse() refuses. Models are not read yet.
SceneFile read_scene_file(const std::filesystem::path& file);

}  // namespace shaolin
