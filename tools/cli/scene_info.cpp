#include "tools/cli/scene_info.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "tools/cli/command.h"
#include "tools/cli/stage.h"

namespace shaolin {
namespace {

struct ObjectFigures {
  std::string scheme;
  std::size_t faces = 0, limit_faces = 0, instances = 0;
};

ObjectFigures figures_of(LoadedModel& model) {
  ObjectFigures figures;
  figures.scheme = model.scheme;
  const std::unique_ptr<LimitSurface> surface = build_surface(std::move(model));
  figures.faces = static_cast<std::size_t>(surface->face_count());
  for (int face = 0; face < surface->face_count(); ++face) figures.limit_faces += surface->has_limit(face);
  return figures;
}

Box control_box(const ControlMesh& mesh) {
  Box box;
  for (const Vec3& position : mesh.positions) box.add(position);
  return box;
}

void print_count(const char* name, std::size_t count) { std::printf("  %-38s %10zu\n", name, count); }

void print_objects(const SceneFile& scene, const std::vector<ObjectFigures>& objects) {
  std::size_t widest = 24;
  for (const SceneFile::Object& object : scene.objects) widest = std::max(widest, object.name.size());
  const int width = static_cast<int>(widest);
  std::printf("\n%-*s   %-10s %10s %10s %10s\n", width, "Objects", "scheme", "faces", "with limit", "instances");
  for (std::size_t i = 0; i < objects.size(); ++i)
    std::printf("  %-*s %-10s %10zu %10zu %10zu\n", width, scene.objects[i].name.c_str(), objects[i].scheme.c_str(),
                objects[i].faces, objects[i].limit_faces, objects[i].instances);
}

}  // namespace

int scene_info(const ModelOptions& options) {
  Stage stage = load_stage(options);
  const SceneFile& scene = stage.scene;
  std::vector<Box> boxes;
  for (const LoadedModel& model : stage.models) boxes.push_back(control_box(model.mesh));
  std::vector<ObjectFigures> objects;
  for (LoadedModel& model : stage.models) objects.push_back(figures_of(model));

  Box bounds;
  for (const SceneFile::Instance& instance : scene.instances) {
    ++objects[instance.object].instances;
    bounds.add(transformed(boxes[instance.object], instance.transform));
  }
  std::size_t shown = 0, distinct = 0, in_all = 0;
  for (const ObjectFigures& object : objects) {
    shown += object.instances > 0;
    distinct += object.instances > 0 ? object.faces : 0;
    in_all += object.instances * object.faces;
  }

  std::printf("scene     %s\n\nScene\n", options.file.c_str());
  print_count("objects", objects.size());
  print_count("objects that are shown", shown);
  print_count("instances", scene.instances.size());
  print_count("materials", scene.look.materials.size() - 1);
  print_count("lights", scene.look.lights.size());
  std::printf("\nControl faces\n");
  print_count("distinct, of objects that are shown", distinct);
  print_count("over all instances", in_all);
  print_objects(scene, objects);
  if (!scene.instances.empty()) {
    std::printf("\nBox around the instances' boxes of control points\n");
    for (const auto& [name, point] : {std::pair("lower", bounds.lower), std::pair("upper", bounds.upper)})
      std::printf("  %-8s %.9g %.9g %.9g\n", name, point.x(), point.y(), point.z());
  }
  return exit_done;
}

}  // namespace shaolin
