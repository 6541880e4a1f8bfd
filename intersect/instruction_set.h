#pragma once
/// Which instructions the intersector runs on.
#include <string_view>

namespace shaolin {

/// The objects of Loop and Catmull-Clark are compiled once for every processor that the build's compiler options name
/// (on x86-64 by default SSE2) and once for AVX2; other schemes are compiled for the first alone. `portable` is the
/// former.
enum class InstructionSet { portable, avx2 };

/// The widest that the library was built with and this processor runs; the environment variable
/// SHAOLIN_INSTRUCTION_SET, `portable` or `avx2`, may ask for less. make_object() chooses by it; answers differ by
/// rounding at most: Eigen sums in another order. Throws InputError for another name, and for one that does not run
/// here.
InstructionSet instruction_set();

/// `portable` or `avx2`.
std::string_view name_of(InstructionSet set);

}  // namespace shaolin
