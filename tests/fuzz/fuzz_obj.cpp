// OBJ files: whatever the bytes, a mesh or an InputError; a mesh comes back from its own file, and a small one takes rays.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <sstream>

#include "intersect/scene.h"
#include "schemes/errors.h"
#include "schemes/limit_surface.h"
#include "schemes/obj.h"

namespace {

void expect(bool holds) {
  if (!holds) std::abort();
}

void write_and_read_again(const shaolin::ControlMesh& mesh) {
  std::stringstream file;
  write_obj(file, mesh);
  const shaolin::ControlMesh again = shaolin::read_obj(file, "again");
  expect(again.positions == mesh.positions && again.face_offsets == mesh.face_offsets &&
         again.face_vertices == mesh.face_vertices && again.holes == mesh.holes && again.cones == mesh.cones);
}

/// High valences and deep sharpness are for other tests: an execution is to take no longer than some milliseconds.
bool is_small(const shaolin::ControlMesh& mesh) { return mesh.face_vertices.size() <= 48; }

void cast_rays(const shaolin::ControlMesh& mesh) {
  const shaolin::Scene scene(mesh, shaolin::default_scheme(mesh));
  const shaolin::Box box = scene.bounds();
  if (!(box.lower.array() <= box.upper.array()).all()) return;
  const shaolin::Vec3 size = box.upper - box.lower;
  if (!size.allFinite()) return;
  for (const shaolin::Vec3& way : {shaolin::Vec3(0.3, -0.2, 1), shaolin::Vec3(-1, 0.1, 0)}) {
    const shaolin::Vec3 origin = box.centre() - 2 * size.norm() * way;
    if (!origin.allFinite()) continue;
    const shaolin::Ray ray{origin, way, 0, std::numeric_limits<double>::infinity()};
    if (const auto hit = scene.intersect(ray)) {
      expect(hit->at.face >= 0 && hit->at.face < mesh.face_count() && hit->sample.position.allFinite());
      expect(scene.occluded(ray));
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream file(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const shaolin::ControlMesh mesh = shaolin::read_obj(file, "fuzzed");
    write_and_read_again(mesh);
    if (is_small(mesh)) cast_rays(mesh);
  } catch (const shaolin::InputError&) {
  }
  return 0;
}
