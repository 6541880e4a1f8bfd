#pragma once
/// The plug-ins of docs/examples and of tests/plugins.
#include <cstdlib>

#include "tests/tools/cli_run.h"

namespace shaolin::test {

inline std::filesystem::path example_plugin(const std::string& name) {
  return std::filesystem::path(environment("SHAOLIN_PLUGINS")) / ("lib" + name + ".so");
}

inline std::filesystem::path bad_plugin(const std::string& name) {
  return std::filesystem::path(environment("SHAOLIN_BAD_PLUGINS")) / ("lib" + name + ".so");
}

/// While it lives, libfaulty.so has this fault when it is loaded; see faulty.cpp.
class Fault {
 public:
  explicit Fault(const char* name) { setenv("SHAOLIN_TEST_FAULT", name, 1); }
  ~Fault() { unsetenv("SHAOLIN_TEST_FAULT"); }
  Fault(const Fault&) = delete;
  Fault& operator=(const Fault&) = delete;
};

/// What libfaulty.so is refused for, by fault: a part of the message.
struct FaultMessage {
  const char *fault, *message;
};
inline constexpr FaultMessage fault_messages[] = {
    {"version", "is a plug-in of version 99, expected version 1"},
    {"entry is null", "returned null, expected a plug-in"},
    {"entry throws", "shaolin_scheme_plugin() failed: no entry"},
    {"no name", "its name is null, expected 1 to 64 letters"},
    {"empty name", "its name is '', expected"},
    {"path as name", "its name is '../../etc', expected"},
    {"face kind", "its face_kind is 5, expected 3 to 4"},
    {"radius", "its radius is 3, expected 1 to 2"},
    {"basis", "its basis is 7, expected 0 to 2"},
    {"basis of radius 2", "its radius is 2 and its basis 1, expected basis 0"},
    {"smoothness", "its smoothness is -1, expected 0 to 1"},
    {"crease", "a crease weight is inf, expected a finite number"},
    {"null vertex", "its callback smooth_vertex is null"},
    {"null edge", "its callback edge_end is null"},
    {"null edge of radius 1", "its callback smooth_edge is null"},
    {"null limits", "its callback smooth_limit is null"},
    {"constructor", "smooth_vertex(3) of the scheme 'Faulty' failed: made of glass"},
    {"throw", "smooth_vertex(5) of the scheme 'Faulty' failed: five is too many"},
    {"throw int", "smooth_vertex(5) of the scheme 'Faulty' failed: it threw something"},
    {"let through", "smooth_vertex(3) of the scheme 'Faulty' failed: out it goes"},
    {"nan", "smooth_vertex(4) of the scheme 'Faulty' gave nan as weight 2 of 3, expected a finite number"},
    {"infinity", "smooth_vertex(4) of the scheme 'Faulty' gave inf as weight 1 of 3"},
    {"unwritten", "smooth_vertex(3) of the scheme 'Faulty' gave nan as weight 1 of 3"},
    {"two weights", "smooth_vertex(3) of the scheme 'Faulty' gave 2 weights, expected 3"},
    {"too many", "edge_end(3, 3) of the scheme 'Faulty' gave 7 weights, expected 4"},
    {"short ring",
     "edge_end(7, 3) of the scheme 'Faulty' failed: it has 6 edge weights and 0 diagonal weights, expected 7 "
     "edge weights and 0 diagonal weights"},
    {"silent failure", "smooth_vertex(3) of the scheme 'Faulty' failed: no reason given"},
    {"long failure", "smooth_vertex(3) of the scheme 'Faulty' failed: xxxxx"},
};

}  // namespace shaolin::test
