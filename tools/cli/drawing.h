#pragma once
/// Plain text and rectangles in a picture.
#include <string>

#include "tools/cli/png.h"

namespace shaolin {

/// The height of a line's capital letters at scale 1, in pixels.
inline constexpr int text_height = 7;

/// The width of one line of text, in pixels.
int text_width(const std::string& text, int scale);

/// Writes ASCII text with its upper left corner at (x, y); each dot of the font is a square of `scale` pixels. What
/// lies outside the picture is cut off.
void draw_text(Picture& picture, int x, int y, int scale, const std::string& text, const SrgbColor& color);

/// Fills the pixels [x, x + width) x [y, y + height); what lies outside the picture is cut off.
void fill_rectangle(Picture& picture, int x, int y, int width, int height, const SrgbColor& color);

}  // namespace shaolin
