#pragma once
/// 8-bit sRGB pictures as PNG files.
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/cli/image.h"

namespace shaolin {

/// A colour in linear light, Rec. 709 primaries, 0 to 1.
using LinearColor = std::array<double, 3>;

/// A colour as PNG stores it.
using SrgbColor = std::array<std::uint8_t, 3>;

/// The sRGB transfer curve (IEC 61966-2-1); what lies outside [0, 1] is clipped.
SrgbColor srgb_from_linear(const LinearColor& color);

struct Picture {
  Picture(int picture_width, int picture_height, const SrgbColor& fill)
      : width(picture_width),
        height(picture_height),
        pixels(static_cast<std::size_t>(picture_width) * picture_height, fill) {}

  SrgbColor& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }

  int width, height;
  std::vector<SrgbColor> pixels;  ///< row by row, the top row first
};

/// The image's colours, over a light backdrop where it has none.
Picture beauty_picture(const Image& image);

/// Throws std::runtime_error if the file cannot be written.
void write_png(const std::filesystem::path& file, const Picture& picture);

}  // namespace shaolin
