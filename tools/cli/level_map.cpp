#include "tools/cli/level_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tools/cli/drawing.h"

namespace shaolin {
namespace {

constexpr SrgbColor background{226, 226, 226};
constexpr SrgbColor panel{250, 250, 250};
constexpr SrgbColor ink{40, 40, 40};

/// The number of pixels of each level, and of none.
struct LevelCounts {
  std::vector<std::size_t> levels;
  std::size_t misses = 0;
  int deepest() const { return static_cast<int>(levels.size()) - 1; }
};

LevelCounts count_levels(const Image& image, int deepest) {
  LevelCounts counts{.levels = std::vector<std::size_t>(static_cast<std::size_t>(deepest) + 1)};
  for (const Pixel& pixel : image.pixels) {
    if (!pixel.hit()) {
      ++counts.misses;
      continue;
    }
    if (pixel.level >= counts.levels.size()) counts.levels.resize(pixel.level + 1);
    ++counts.levels[pixel.level];
  }
  return counts;
}

/// OKLab to linear Rec. 709 (B. Ottosson, "A perceptual color space for image processing", 2020).
LinearColor linear_from_oklab(double lightness, double a, double b) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// One line of the legend.
struct Entry {
  std::string label, count;
  SrgbColor color;
};

std::vector<Entry> legend_entries(const LevelCounts& counts) {
  std::vector<Entry> entries;
  for (int level = 0; level <= counts.deepest(); ++level)
    entries.push_back({std::to_string(level), std::to_string(counts.levels[level]),
                       srgb_from_linear(level_color(level, counts.deepest()))});
  entries.push_back({"none", std::to_string(counts.misses), background});
  return entries;
}

/// The legend's measures, all multiples of the font's scale.
class Legend {
 public:
  Legend(std::vector<Entry> entries, int image_height) : entries_(std::move(entries)) {
    // 1 dot per 400 rows keeps the text readable when the picture is shown whole; less if the lines do not fit.
    scale_ = std::clamp(image_height / 400, 1, 8);
    while (scale_ > 1 && height() > image_height) --scale_;
  }

  int width() const { return 2 * margin() + swatch() + label_width() + count_width() + 2 * gap(); }
  int height() const { return 2 * margin() + line() * (static_cast<int>(entries_.size()) + 1); }

  void draw(Picture& picture, int left) const {
    fill_rectangle(picture, left, 0, picture.width - left, picture.height, panel);
    const int label_left = left + margin() + swatch() + gap();
    const int right = left + width() - margin();
    int y = margin();
    const auto write_line = [&](const std::string& label, const std::string& count) {
      draw_text(picture, label_left, y, scale_, label, ink);
      draw_text(picture, right - text_width(count, scale_), y, scale_, count, ink);
      y += line();
    };
    write_line(title_, count_title_);
    for (const Entry& entry : entries_) {
      fill_rectangle(picture, left + margin(), y - 2 * scale_, swatch(), line() - scale_, entry.color);
      write_line(entry.label, entry.count);
    }
  }

 private:
  int margin() const { return 8 * scale_; }
  int gap() const { return 9 * scale_; }
  int swatch() const { return 18 * scale_; }
  int line() const { return (text_height + 5) * scale_; }
  int label_width() const { return widest(title_, &Entry::label); }
  int count_width() const { return widest(count_title_, &Entry::count); }
  int widest(const std::string& title, std::string Entry::*column) const {
    int width = text_width(title, scale_);
    for (const Entry& entry : entries_) width = std::max(width, text_width(entry.*column, scale_));
    return width;
  }

  const std::string title_ = "level", count_title_ = "pixels";
  std::vector<Entry> entries_;
  int scale_;
};

}  // namespace

LinearColor level_color(int level, int deepest) {
  const double depth = deepest > 0 ? static_cast<double>(level) / deepest : 0;
  const double hue = (300 - 195 * depth) * std::numbers::pi / 180;
  const double lightness = 0.42 + 0.48 * depth;
  const double chroma = 0.13 + 0.03 * depth;
  return linear_from_oklab(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

Picture level_map(const Image& image, const View& view, int deepest) {
  const LevelCounts counts = count_levels(image, deepest);
  const Legend legend(legend_entries(counts), image.size.height);
  Picture picture(image.size.width + legend.width(), std::max(image.size.height, legend.height()), background);
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = 0; x < image.size.width; ++x) {
      const Pixel& pixel = image.at(x, y);
      if (!pixel.hit()) continue;
      const Vec3 normal(pixel.normal[0], pixel.normal[1], pixel.normal[2]);
      const double facing = std::abs(normal.dot(view.ray(x, y).direction));
      LinearColor color = level_color(static_cast<int>(pixel.level), counts.deepest());
      for (double& channel : color) channel *= 0.55 + 0.45 * facing;
      picture.at(x, y) = srgb_from_linear(color);
    }
  }
  legend.draw(picture, image.size.width);
  return picture;
}

}  // namespace shaolin
