/// What a program that is stopped leaves behind: nothing.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/tools/cli_run.h"

namespace shaolin::test {

TEST_CASE("A signal that ends the tool removes its unfinished files", "[tools][cli]") {
  const Folder folder;
  const std::string tool = environment("SHAOLIN_BINARY"), model = data_file("rook.obj"), image = folder / "image.exr";
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    // Far more pixels than the time until the signal allows.
    execl(tool.c_str(), "shaolin", "render", model.c_str(), "-o", image.c_str(), "--size", "8000x8000", nullptr);
    _exit(127);
  }
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(30);
  while (folder.list().empty() && Clock::now() < deadline) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const bool began = !folder.list().empty();
  kill(child, SIGTERM);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(began);
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGTERM);
  CHECK(folder.list().empty());
}

}  // namespace shaolin::test
