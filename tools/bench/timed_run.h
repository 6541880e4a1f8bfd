#pragma once
/// One run of many contenders.
#include <span>

#include "tools/bench/measure.h"

namespace shaolin {

/// Appends a run's times to each measurement: what is cold whole, contender after contender, each with a new scene;
/// then, with all scenes held and all rays traced once, what is warm by trace_in_turns(). On this thread. Throws
/// std::runtime_error if a contender's hits are not as many as when it was verified.
void time_run(const Subject& subject, std::span<Measurement* const> contenders);

}  // namespace shaolin
