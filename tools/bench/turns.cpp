#include "tools/bench/turns.h"

#include <algorithm>

#include "tools/bench/thread_stopwatch.h"

namespace shaolin {

Lap trace_once(const Tracer& tracer, std::span<const Ray> rays, Query query) {
  ThreadStopwatch stopwatch;
  Lap lap;
  if (query == Query::intersect)
    for (const Ray& ray : rays) lap.hits += tracer.intersect(ray).has_value();
  else
    for (const Ray& ray : rays) lap.hits += tracer.occluded(ray);
  lap.seconds = stopwatch.lap();
  return lap;
}

std::vector<Lap> trace_in_turns(std::span<const Tracer* const> tracers, std::span<const Ray> rays, Query query,
                                std::size_t chunk) {
  chunk = std::min(chunk, (rays.size() + least_turns - 1) / least_turns);
  std::vector<std::span<const Ray>> chunks;
  for (std::size_t begin = 0; begin < rays.size(); begin += chunk)
    chunks.push_back(rays.subspan(begin, std::min(chunk, rays.size() - begin)));
  std::vector<Lap> sums(tracers.size());
  for (std::size_t turn = 0; turn < chunks.size(); ++turn)
    for (std::size_t i = 0; i < tracers.size(); ++i) {
      trace_once(*tracers[i], turn > 0 ? chunks[turn - 1] : chunks.back(), query);
      const Lap lap = trace_once(*tracers[i], chunks[turn], query);
      sums[i].seconds += lap.seconds;
      sums[i].hits += lap.hits;
    }
  return sums;
}

}  // namespace shaolin
