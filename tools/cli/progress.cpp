#include "tools/cli/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace shaolin {
namespace {

constexpr int bar_width = 40;

}  // namespace

Progress::Progress(std::size_t total) : total_(total), visible_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

void Progress::advance() {
  const std::size_t done = ++done_;
  if (visible_) draw(static_cast<int>(100 * done / total_));
}

void Progress::draw(int percent) {
  const std::lock_guard lock(mutex_);
  if (percent <= drawn_percent_) return;
  drawn_percent_ = percent;
  const int filled = percent * bar_width / 100;
  const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
  std::fprintf(stderr, "\r[%s] %3d%%", bar.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace shaolin
