#pragma once
#include <string>

namespace shaolin::test {

/// The cube from -1 to 1 as an OBJ file's text; face 0 is the one at z = 1.
inline const std::string cube_text =
    "v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
    "f 1 2 3 4\nf 6 5 8 7\nf 2 6 7 3\nf 5 1 4 8\nf 4 3 7 8\nf 5 6 2 1\n";

}  // namespace shaolin::test
