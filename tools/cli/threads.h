#pragma once
/// How many threads a subcommand may use.
#include <CLI/CLI.hpp>
#include <functional>

namespace shaolin {

/// Adds --threads N.
void add_threads_option(CLI::App& app, int& threads);

/// The number of threads that `threads` asks for: itself, or the machine's number if it is 0.
int thread_count(int threads);

/// Runs `work`; oneTBB's algorithms inside it use thread_count(threads) threads.
void run_with_threads(int threads, const std::function<void()>& work);

}  // namespace shaolin
