#include "tools/bench/plot_labels.h"

#include <algorithm>

namespace shaolin {
namespace {

constexpr double character_width = 0.6 * PointLabels::font_size;  // of a digit; a point is narrower
constexpr double character_height = 0.75 * PointLabels::font_size;

}  // namespace

void PointLabels::add_mark(double x, double y) { taken_.push_back({x - radius, y - radius, x + radius, y + radius}); }

std::optional<LabelPlace> PointLabels::place(double x, double y, std::size_t characters) {
  const double width = character_width * static_cast<double>(characters);
  const double right = x + 6, left = x - 6 - width, above = y - 5, below = y + 5 + character_height;
  const double middle = y + character_height / 2, centre = x - width / 2;
  for (const LabelPlace& at : {LabelPlace{right, above},
                               {right, below},
                               {left, above},
                               {left, below},
                               {right, middle},
                               {left, middle},
                               {centre, above - 1},
                               {centre, below + 1}}) {
    const Rectangle one{at.x, at.y - character_height, at.x + width, at.y};
    const bool is_free = std::none_of(taken_.begin(), taken_.end(), [&](const Rectangle& other) {
      return one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;
    });
    if (!is_free) continue;
    taken_.push_back(one);
    return at;
  }
  return std::nullopt;
}

// Pools adjacent violators: with the gaps taken out, heights must not descend, and runs that do take their mean.
std::vector<double> moved_apart(const std::vector<double>& wanted, double gap) {
  struct Run {
    double sum;
    std::size_t count;

    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Run> runs;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    runs.push_back({wanted[i] - gap * static_cast<double>(i), 1});
    while (runs.size() > 1 && runs[runs.size() - 2].mean() > runs.back().mean()) {
      const Run last = runs.back();
      runs.pop_back();
      runs.back().sum += last.sum;
      runs.back().count += last.count;
    }
  }
  std::vector<double> heights;
  for (const Run& run : runs)
    for (std::size_t i = 0; i < run.count; ++i)
      heights.push_back(run.mean() + gap * static_cast<double>(heights.size()));
  return heights;
}

}  // namespace shaolin
