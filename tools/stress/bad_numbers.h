#pragma once
/// Rays with a number that makes no sense, or hardly any, and what must be answered.
#include "tools/stress/subject.h"

namespace shaolin {
class SampleRandom;
}

namespace shaolin::stress {

enum class Expected {
  error,  ///< InputError
  miss,   ///< an empty interval
  sound   ///< a miss or a hit as any other: denormal and huge numbers are numbers
};

struct BadRay {
  Ray ray;
  Expected expected;
};

/// A ray with one number replaced: by NaN or infinity (also in the interval), a direction by zero, numbers by denormal
/// ones, the direction's length by 1e-300 or 1e300, or the interval by an empty one.
BadRay spoiled(Ray ray, SampleRandom& random);

/// How much longer rays with bad numbers take for their closest hit, or its refusal, than the same rays without, on the
/// first of sound_models(): two thousand of each on this thread, by its clock, the least time of five.
double bad_number_slowdown(const QueriesOf& queries_of);

}  // namespace shaolin::stress
