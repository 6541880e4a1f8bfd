#pragma once
/// Curves as SVG, both axes logarithmic.
#include <ostream>
#include <string>
#include <vector>

namespace shaolin {

struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;  ///< ends of the bar through y; none if both are 0
  std::string label{};       ///< beside the point, where there is room
};

struct PlotSeries {
  std::string name{};
  std::string color{};
  std::vector<PlotPoint> points{};  ///< joined in this order; those that are not positive are left out
  bool dashed = false;
  bool level_line = false;  ///< no marks but a line across the plot, at y of the first point, with its label at the end
};

struct Plot {
  std::string x_label{}, y_label{};
  std::vector<PlotSeries> series{};
  std::vector<double> x_ticks{};  ///< values to name on the x axis; empty: powers of ten
};

/// One svg element with a legend of all series by name (each name once).
void write_svg(std::ostream& out, const Plot& plot);

}  // namespace shaolin
