#pragma once
/// A compiler hint for the innermost functions.

/// In a unit as large as scene.cpp GCC leaves even Eigen's one-line expressions as calls; told to inline all that these
/// functions call, a picture takes a quarter fewer instructions. Not under sanitizers: compiling would take many
/// minutes.
#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
#define SHAOLIN_FLATTEN [[gnu::flatten]]
#else
#define SHAOLIN_FLATTEN
#endif
