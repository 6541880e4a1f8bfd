#pragma once
/// A scheme's masks in numbers, by valence.
#include "schemes/load_plugin.h"

namespace shaolin {

/// "triangles" or "quads".
const char* faces_of(FaceKind kind);

/// Which rules apply along creases: the scheme's own weights, or the cubic B-spline curve's if its author gave none.
void print_crease_rules(const LoadedPlugin& scheme);

/// Prints all masks of a scheme to stdout. Throws InputError if a mask of a plug-in fails.
void print_masks(const LoadedPlugin& scheme);

}  // namespace shaolin
