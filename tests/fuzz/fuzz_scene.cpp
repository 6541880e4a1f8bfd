// Scene files: whatever the bytes, a scene whose parts refer to each other, or an InputError.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "schemes/errors.h"
#include "tools/cli/scene_file.h"

namespace {

/// One file a process, which goes with it. (Models are not read: they are not there.)
class FuzzedFile {
 public:
  FuzzedFile() : path(std::filesystem::temp_directory_path() / ("fuzzed" + std::to_string(getpid()) + ".json")) {}
  ~FuzzedFile() { std::filesystem::remove(path); }
  FuzzedFile(const FuzzedFile&) = delete;
  FuzzedFile& operator=(const FuzzedFile&) = delete;

  const std::filesystem::path path;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FuzzedFile file;
  std::ofstream(file.path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const shaolin::SceneFile scene = shaolin::read_scene_file(file.path);
    if (scene.instances.size() > shaolin::most_instances) std::abort();
    for (const auto& instance : scene.instances)
      if (instance.object >= scene.objects.size() || !instance.transform.matrix().allFinite()) std::abort();
  } catch (const shaolin::InputError&) {
  }
  return 0;
}
