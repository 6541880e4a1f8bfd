#include "tools/cli/framing.h"

#include <unordered_map>

#include "schemes/errors.h"

namespace shaolin {
namespace {

/// An object's share of what a default camera frames. Its bounds hold for certain, which can make them several times as
/// wide as the surface where masks have negative weights; the control points of its faces, with a quarter of their
/// extent around for what such schemes overshoot, are not.
Box frame_of(const Object& object) {
  const LimitSurface& surface = object.surface();
  const ControlMesh& mesh = surface.control_mesh();
  Box control;
  for (int f = 0; f < mesh.face_count(); ++f) {
    if (!surface.has_limit(f)) continue;
    for (const int vertex : mesh.face(f)) control.add(mesh.positions[static_cast<std::size_t>(vertex)]);
  }
  const Box wide = control.expanded(0.25), bounds = object.bounds();
  return {bounds.lower.cwiseMax(wide.lower), bounds.upper.cwiseMin(wide.upper)};
}

Box frame_of(const Scene& scene) {
  std::unordered_map<const Object*, Box> frames;
  Box all;
  for (const Instance& instance : scene.instances()) {
    const auto [known, is_new] = frames.try_emplace(instance.object.get());
    if (is_new) known->second = frame_of(*instance.object);
    const bool moved = instance.transform.matrix() != Affine::Identity().matrix();
    all.add(moved ? transformed(known->second, instance.transform) : known->second);
  }
  return all;
}

}  // namespace

Camera choose_camera(const Stage& stage, const Scene& scene, ImageSize size) {
  if (stage.scene.camera) return *stage.scene.camera;
  if (scene.statistics().faces == 0)
    throw InputError("no face has a limit surface, so that there is nothing to frame; expected --camera", stage.file);
  return default_camera(frame_of(scene), size);
}

}  // namespace shaolin
