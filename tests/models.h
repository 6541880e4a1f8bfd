#pragma once
// Models to test with: the files of data/, and of the shapes folder where there is one.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"
#include "tests/meshes.h"

namespace shaolin {

struct Model {
  std::string name, scheme;
  ControlMesh mesh;
};

namespace detail {

/// Files in the shapes folder say in their names what they are for; they carry no hint that the library reads.
inline std::string scheme_of(const std::string& name, const ControlMesh& mesh, bool named) {
  if (!named) return default_scheme(mesh);
  for (const char* scheme : {"loop", "bilinear"})
    if (name.find(scheme) != std::string::npos) return scheme;
  return "catmark";
}

inline void add_folder(std::vector<Model>& models, const char* variable, bool named) {
  const char* folder = std::getenv(variable);
  if (!folder) return;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".obj") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    try {
      Model model{file.stem().string(), {}, read_obj(file)};
      model.scheme = scheme_of(model.name, model.mesh, named);
      make_limit_surface(model.mesh, model.scheme);
      models.push_back(std::move(model));
    } catch (const InputError& error) {
      // The tags that a later version will support say so; anything else is a failure.
      if (std::string(error.what()).find("not supported yet") == std::string::npos) throw;
    }
  }
}

}  // namespace detail

/// The models of data/ ($SHAOLIN_DATA), then those of the shapes folder ($SHAOLIN_SHAPES) if there is one.
inline const std::vector<Model>& all_models() {
  static const std::vector<Model> models = [] {
    std::vector<Model> result;
    detail::add_folder(result, "SHAOLIN_DATA", false);
    detail::add_folder(result, "SHAOLIN_SHAPES", true);
    if (result.empty()) throw std::logic_error("$SHAOLIN_DATA holds no models; a test without any could not fail");
    return result;
  }();
  return models;
}

}  // namespace shaolin
