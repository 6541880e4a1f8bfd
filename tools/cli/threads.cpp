#include "tools/cli/threads.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

namespace shaolin {

void add_threads_option(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "Number of threads; 0: all of the machine. Results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->type_name("N")
      ->capture_default_str();
}

int thread_count(int threads) { return threads > 0 ? threads : tbb::info::default_concurrency(); }

void run_with_threads(int threads, const std::function<void()>& work) {
  const int count = thread_count(threads);
  // The arena alone would be enough to use fewer threads than the machine has; more than that takes the control.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  tbb::task_arena arena(count);
  arena.execute(work);
}

}  // namespace shaolin
