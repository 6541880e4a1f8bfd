#pragma once
/// What a rendered image holds at each pixel.
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "tools/cli/camera.h"

namespace shaolin {

/// The value of `face`, `level` and `instance` where nothing was hit.
inline constexpr std::uint32_t no_id = std::numeric_limits<std::uint32_t>::max();

/// The closest hit through the pixel's centre and its colour; the initial values stand for a miss.
struct Pixel {
  std::array<float, 3> color{};                      ///< linear, Rec. 709 primaries; the background on a miss, or black
  float alpha = 0;                                   ///< 1 on a hit and where there is a background
  float z = std::numeric_limits<float>::infinity();  ///< distance from the eye
  std::array<float, 3> normal{};                     ///< unit, along du x dv (not turned towards the eye)
  std::array<float, 3> position{};
  std::array<float, 2> uv{};
  std::uint32_t face = no_id;
  std::uint32_t level = no_id;     ///< refinement level of the patch that was met
  std::uint32_t instance = no_id;  ///< in a scene file's order

  bool hit() const { return face != no_id; }
};

struct Image {
  explicit Image(ImageSize image_size)
      : size(image_size), pixels(static_cast<std::size_t>(image_size.width) * image_size.height) {}

  Pixel& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * size.width + x]; }
  const Pixel& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * size.width + x]; }

  ImageSize size;
  std::vector<Pixel> pixels;  ///< row by row, the top row first
};

}  // namespace shaolin
