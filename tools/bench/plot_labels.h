#pragma once
/// Where the labels of a plot stand, so that they can be read. Pixels, y downwards.
#include <cstddef>
#include <optional>
#include <vector>

namespace shaolin {

/// A line of text, from its left end at the height of its base line.
struct LabelPlace {
  double x, y;
};

/// Labels of points. One that finds no room is left out: the tables beside the plot hold what it says.
class PointLabels {
 public:
  static constexpr double font_size = 10;
  static constexpr double radius = 3.2;  ///< of a point's mark

  /// A point's mark, which no label may cover.
  void add_mark(double x, double y);

  /// The first place around a mark, right of it and above if possible, that is free, which it is no longer then.
  std::optional<LabelPlace> place(double x, double y, std::size_t characters);

 private:
  struct Rectangle {
    double left, top, right, bottom;
  };

  std::vector<Rectangle> taken_{};
};

/// Heights of lines of text one below the other, which want to be at `wanted` (ascending) and must be `gap` apart:
/// those of the least sum of squared distances from there.
std::vector<double> moved_apart(const std::vector<double>& wanted, double gap);

}  // namespace shaolin
