#include "instruction_set.h"

#include <cstdlib>
#include <string>

#include "../schemes/errors.h"

namespace shaolin {

namespace {

bool runs_avx2() {
#ifdef SHAOLIN_HAS_AVX2
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

}  // namespace

InstructionSet instruction_set() {
  static const InstructionSet widest = runs_avx2() ? InstructionSet::avx2 : InstructionSet::portable;
  const char* const wanted = std::getenv("SHAOLIN_INSTRUCTION_SET");
  if (!wanted || *wanted == '\0' || wanted == name_of(widest)) return widest;
  if (wanted == name_of(InstructionSet::portable)) return InstructionSet::portable;
  throw InputError("SHAOLIN_INSTRUCTION_SET is '" + std::string(wanted) + "'; expected 'portable'" +
                   (widest == InstructionSet::avx2 ? " or 'avx2'" : ", for there is no other on this processor"));
}

std::string_view name_of(InstructionSet set) { return set == InstructionSet::avx2 ? "avx2" : "portable"; }

}  // namespace shaolin
