// Plug-ins: whatever their fields and masks, a scheme or an InputError.
#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "schemes/errors.h"
#include "schemes/load_plugin.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Held open, so that load_plugin() finds it with the bytes that it is given here.
  static void* const library = dlopen(SHAOLIN_FUZZED_PLUGIN, RTLD_NOW | RTLD_LOCAL);
  static const auto set = library ? reinterpret_cast<void (*)(const std::uint8_t*, std::size_t)>(
                                        dlsym(library, "fuzz_plugin_with"))
                                  : nullptr;
  if (!set) {
    std::fprintf(stderr, "%s\n", dlerror());
    std::abort();
  }
  set(data, size);
  try {
    const shaolin::LoadedPlugin plugin = shaolin::load_plugin(SHAOLIN_FUZZED_PLUGIN);
    if (plugin.name.empty() || !plugin.masks) std::abort();
    for (const int n : {1, 2, 9, 40}) plugin.masks->smooth_vertex(n);
  } catch (const shaolin::InputError&) {
  }
  return 0;
}
