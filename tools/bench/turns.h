#pragma once
/// Many contenders that are asked the same rays, a few thousand at a time in turns, so that a busy moment of the
/// machine meets all of them alike.
#include <cstddef>
#include <span>
#include <vector>

#include "tools/bench/contender.h"

namespace shaolin {

enum class Query { intersect, occluded };

/// What rays took, and how many of them hit.
struct Lap {
  double seconds = 0;
  std::size_t hits = 0;
};

/// On this thread.
Lap trace_once(const Tracer& tracer, std::span<const Ray> rays, Query query);

/// The rays of a turn: some ten milliseconds. By then caches hold again what they would if there were no turns.
inline constexpr std::size_t chunk_rays = 16384;

/// Of few rays turns are shorter, so that none is traced twice in a row: processors learn the branches of a short
/// sequence by heart.
inline constexpr std::size_t least_turns = 4;

/// The first `chunk` rays (fewer if there would be less than least_turns) by each tracer after the other, then the
/// next, until all are asked: the sums by tracer. A turn begins with the chunk before (the first: with the last), which
/// does not count: others have used the caches since, and a tracer whose data are large would pay most.
std::vector<Lap> trace_in_turns(std::span<const Tracer* const> tracers, std::span<const Ray> rays, Query query,
                                std::size_t chunk = chunk_rays);

}  // namespace shaolin
