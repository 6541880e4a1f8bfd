#include "tools/cli/drawing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <stb_easy_font.h>

namespace shaolin {
namespace {

/// One corner of the font's quads, as stb_easy_font lays it out.
struct FontCorner {
  float x, y, z;
  unsigned char color[4];
};

std::vector<FontCorner> font_corners(std::string text) {
  constexpr std::size_t corners_per_character = 128;  // twice what the widest glyphs need
  std::vector<FontCorner> corners(corners_per_character * (text.size() + 1));
  const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(FontCorner)));
  corners.resize(4 * static_cast<std::size_t>(quads));
  return corners;
}

}  // namespace

int text_width(const std::string& text, int scale) {
  std::string copy = text;  // the font's interface is not const
  return scale * stb_easy_font_width(copy.data());
}

void draw_text(Picture& picture, int x, int y, int scale, const std::string& text, const SrgbColor& color) {
  const std::vector<FontCorner> corners = font_corners(text);
  for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
    const FontCorner& upper_left = corners[i];
    const FontCorner& lower_right = corners[i + 2];
    const auto dots = [scale](float length) { return scale * static_cast<int>(std::lround(length)); };
    fill_rectangle(picture, x + dots(upper_left.x), y + dots(upper_left.y), dots(lower_right.x - upper_left.x),
                   dots(lower_right.y - upper_left.y), color);
  }
}

void fill_rectangle(Picture& picture, int x, int y, int width, int height, const SrgbColor& color) {
  const int right = std::min(x + width, picture.width);
  const int bottom = std::min(y + height, picture.height);
  for (int row = std::max(y, 0); row < bottom; ++row)
    for (int column = std::max(x, 0); column < right; ++column) picture.at(column, row) = color;
}

}  // namespace shaolin
