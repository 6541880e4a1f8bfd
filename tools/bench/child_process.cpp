#include "tools/bench/child_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace shaolin {
namespace {

/// _exit() and not exit(): the parent's buffers and static objects are the parent's to flush and to destroy.
[[noreturn]] void run_and_exit(const std::function<void()>& work) {
  int status = EXIT_SUCCESS;
  try {
    work();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    status = EXIT_FAILURE;
  }
  std::cout.flush();
  _exit(status);
}

}  // namespace

std::size_t run_in_child(const std::function<void()>& work) {
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) run_and_exit(work);
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS)
    throw std::runtime_error("a measured run failed");
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

}  // namespace shaolin
