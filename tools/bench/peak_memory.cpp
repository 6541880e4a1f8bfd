#include "tools/bench/peak_memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace shaolin {
namespace {

/// A line of /proc/self/status in bytes, 0 if there is none.
std::size_t status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (std::size_t kibibytes = 0; word == key + ":" && file >> kibibytes) return kibibytes * 1024;
  return 0;
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew (proc(5)); getrusage's never falls
  before_ = status_bytes("VmRSS");
}

std::size_t PeakMemory::growth() const { return std::max(status_bytes("VmHWM"), before_) - before_; }

}  // namespace shaolin
