#include "tools/cli/png.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

namespace shaolin {
namespace {

/// Light grey, a little darker towards the bottom, so that the model seems to stand in a room.
LinearColor backdrop(int y, int height) {
  const double down = (y + 0.5) / height;
  return {0.78 - 0.30 * down, 0.80 - 0.30 * down, 0.83 - 0.30 * down};
}

}  // namespace

SrgbColor srgb_from_linear(const LinearColor& color) {
  SrgbColor encoded;
  for (int i = 0; i < 3; ++i) {
    const double c = std::clamp(color[i], 0.0, 1.0);
    const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    encoded[i] = static_cast<std::uint8_t>(std::lround(255 * s));
  }
  return encoded;
}

Picture beauty_picture(const Image& image) {
  Picture picture(image.size.width, image.size.height, SrgbColor{});
  for (int y = 0; y < picture.height; ++y) {
    const SrgbColor background = srgb_from_linear(backdrop(y, picture.height));
    for (int x = 0; x < picture.width; ++x) {
      const Pixel& pixel = image.at(x, y);
      const auto& [r, g, b] = pixel.color;
      picture.at(x, y) = pixel.alpha > 0 ? srgb_from_linear({r, g, b}) : background;
    }
  }
  return picture;
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
  // Through memory: the encoder's own file output does not notice a full disk.
  std::string bytes;
  const auto append = [](void* target, void* data, int size) {
    static_cast<std::string*>(target)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  constexpr int channels = 3;
  const int stride = picture.width * channels;
  const bool encoded = stbi_write_png_to_func(append, &bytes, picture.width, picture.height, channels,
                                              picture.pixels.data(), stride) != 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!encoded || !stream) throw std::runtime_error(file.string() + ": cannot write the PNG file");
}

}  // namespace shaolin
