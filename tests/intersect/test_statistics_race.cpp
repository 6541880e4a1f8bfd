// Work that two threads do twice is counted once: the loser's is thrown away, and holds no memory.
#include <atomic>
#include <thread>

#include "intersect/scene.h"
#include "tests/catch.h"
#include "tests/models.h"

namespace shaolin {

namespace {

/// The statistics of a fresh scene after the same ray from `threads` threads, which start together.
Statistics after(const ControlMesh& mesh, int threads) {
  const Scene scene(mesh, "catmark");
  std::atomic<int> ready{0};
  std::vector<std::thread> running;
  for (int k = 0; k < threads; ++k)
    running.emplace_back([&] {
      for (++ready; ready < threads;) std::this_thread::yield();
      scene.intersect({{0.3, 0.2, 9}, {0, 0, -1}});
    });
  for (std::thread& thread : running) thread.join();
  return scene.statistics();
}

}  // namespace

TEST_CASE("Threads that meet in a patch count its split and its bytes once", "[intersect][scene][statistics]") {
  const ControlMesh mesh = prism(7);
  const Statistics one = after(mesh, 1);
  int differ = 0;
  for (int round = 0; round < 200; ++round) {
    const Statistics two = after(mesh, 2);
    CHECK(two.faces_touched == one.faces_touched);
    differ += two.patches_split != one.patches_split || two.bytes != one.bytes;
  }
  CHECK(differ == 0);
}

}  // namespace shaolin
